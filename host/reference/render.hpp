// The scalar double-precision renderer that the kernels are compared with: plain, one sample after another, written
// from PICTURE.md alone. No speed to speak of; no BVH, no early stop, no float arithmetic.
#pragma once
#include <functional>

#include "film/film.hpp"
#include "plan/render_plan.hpp"
#include "reference/scatter.hpp"

namespace brume::reference {

// The sums of FilmPixel before they become float.
struct PixelD {
  dvec3 radiance{0}, squares{0}, normal{0}, transmittance{0};
  double samples = 0, depth = 0, hits = 0, lookups = 0, dropped_rays = 0, dropped_weight = 0, invalid = 0, clear = 0,
         error = 0;
  uint key = 0;
};

// One sample of one ray, which begins `start` before its origin; `samples` is 1.
PixelD ray_render(const Context& context, const RayD& ray, const RandomStream& random = {}, double start = 0);

// All samples of pixel (x, y), y = 0 at the top; depth from the camera, in world units. `moved`, if given, takes each
// camera ray to the one that is followed.
PixelD pixel_render(const Context& context, int x, int y, const std::function<RayD(const RayD&)>& moved = {});

// Renders the crop of scene.frame and overwrites those pixels; FilmPixel::shadow_rays, a statistic of devices, stays 0.
// The film must have the size of the camera, else RuntimeError.
void render(const PlannedScene& scene, Film& film, const Options& options = {});

}  // namespace brume::reference
