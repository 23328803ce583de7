// Refuses scenes whose rendering would not end in a lifetime of patience, with the number.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.hpp"
#include "flat/flatten_parts.hpp"

namespace brume {

namespace {

constexpr double LOOKUPS_MAX = 1e15;  // eleven days at 10^9 a second

// Density lookups (of a constant medium: light rays) of one view ray through a marched medium, along its longest way.
double ray_lookups(const FlatScene& scene, const Medium& m, double steps, double lights) {
  const bool constant = method_rule(m.method) == RULE_PRODUCT, traced = m.light_grids < 0 && !constant;
  const bool scatters = std::max({m.sigma_s.x, m.sigma_s.y, m.sigma_s.z}) > 0;
  return steps * (1 + (scatters ? lights * (traced ? steps : 1) : 0)) * (scene.frame.camera.spp);
}

}  // namespace

void work_check(const SceneDesc& desc, const FlatScene& scene) {
  const Frame& f = scene.frame;
  const double pixels = double(f.crop_x1 - f.crop_x0) * (f.crop_y1 - f.crop_y0);
  const double steps = std::ceil(std::sqrt(3.0) / desc.render.step), lights = double(scene.lights.size());
  double lookups = 0;
  for (std::size_t i = 0; i < scene.media.size(); ++i) {
    const Medium m = scene.medium(i);
    if (method_has_step(m.method)) lookups += pixels * ray_lookups(scene, m, steps, lights);
  }
  if (lookups <= LOOKUPS_MAX) return;
  char text[320];
  std::snprintf(
      text, sizeof text,
      "%g asks for up to %.0f steps a ray and %.1g density lookups in all (%.0f pixels, %d samples, %.0f lights), "
      "more than the %g allowed; a longer step, a smaller film or \"shadow\": \"grid\" takes fewer",
      desc.render.step, steps, lookups, pixels, f.camera.spp, lights, LOOKUPS_MAX);
  throw InputError(desc.file.string() + ": /render/step: " + text);
}

}  // namespace brume
