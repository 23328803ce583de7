// Rays that surfaces send on: what is followed, what is left out, and that both are counted alike by kernels and
// reference.
#include <cmath>
#include <string>

#include "physics/closed_form.hpp"
#include "shared/ray.h"

namespace brume::test {
namespace {

// Quads of one material, `pairs` of them before and behind the camera, seen along their normal; the glow is what each
// hit adds.
std::string facing_mirrors(const std::string& material, int depth, int pairs = 1, double cutoff = 0) {
  std::string shapes;
  for (int i = 1; i <= pairs; ++i)
    for (const int side : {-i, i})
      shapes += (shapes.empty() ? "" : ",") + std::string(R"({"type": "quad", "corner": [-2, -2, )") +
                std::to_string(side) + R"(], "u": [4, 0, 0], "v": [0, 4, 0], "material": "m"})";
  return R"({"camera": {"type": "orthographic", "eye": [0, 0, 0], "target": [0, 0, -1], "height": 1}, "film": {"size": [2, 2]},
    "materials": {"m": {"diffuse": 0, "emission": 1, )" +
         material + R"(}}, "shapes": [)" + shapes + R"(], "render": {"cutoff": )" + std::to_string(cutoff) +
         R"(, "max_depth": )" + std::to_string(depth) + "}}";
}

struct Pixel {
  double radiance, rays, dropped;
};

Pixel kernel_pixel(const std::string& scene, int lanes) {
  const PlannedScene flat = flatten(scene_read_text(scene, "mirrors.json", {}), {bvh_width_for(lanes), {}});
  Film film({2, 2});
  Renderer(pocl(), flat, {lanes, false, 0}).render(film, [](double) { return true; });
  const FilmPixel& p = film.pixels()[0];
  return {p.radiance.y, p.secondary_rays, p.dropped_weight};
}

reference::PixelD reference_pixel(const std::string& scene) {
  const PlannedScene flat = flatten(scene_read_text(scene, "mirrors.json", {}), {4, {}});
  return reference::pixel_render(reference::Context(flat, {}), 0, 0);
}

TEST(Paths, AChainOfMirrorsIsFollowedToItsEnd) {
  const double expected = 2 - std::pow(0.5, 64);
  const std::string scene = facing_mirrors(R"("reflection": 0.5)", 64);
  const Pixel kernel = kernel_pixel(scene, 8);
  EXPECT_NEAR(kernel.radiance, expected, 1e-6);
  EXPECT_EQ(kernel.rays, 64);
  EXPECT_EQ(kernel.dropped, 0);
  EXPECT_NEAR(reference_pixel(scene).radiance.y, expected, 1e-12);
}

// Nothing is dropped before all of them are more than the bound.
TEST(Paths, UpToDepth11AllAreFollowed) {
  const Pixel kernel = kernel_pixel(facing_mirrors(R"("reflection": 0.1, "refraction": 0.9, "ior": 1)", 11, 12), 8);
  EXPECT_NEAR(kernel.radiance, 12, 1e-4);  // each bounce passes on all of the light
  EXPECT_EQ(kernel.dropped, 0);
}

TEST(Paths, DepthEndsThemFirst) {
  const Pixel kernel = kernel_pixel(facing_mirrors(R"("reflection": 0.5)", 3), 1);
  EXPECT_NEAR(kernel.radiance, 1 + 0.5 + 0.25 + 0.125, 1e-6);
  EXPECT_EQ(kernel.rays, 3);
  EXPECT_EQ(kernel.dropped, 0);
}

TEST(Paths, WeakRaysAreDroppedAndCounted) {
  const std::string scene = facing_mirrors(R"("reflection": 0.5)", 64, 1, 0.1);
  const Pixel kernel = kernel_pixel(scene, 8);
  EXPECT_NEAR(kernel.radiance, 1 + 0.5 + 0.25 + 0.125, 1e-6);
  EXPECT_EQ(kernel.rays, 3);
  EXPECT_NEAR(kernel.dropped, 0.0625, 1e-7);
  EXPECT_NEAR(reference_pixel(scene).radiance.y, 1.875, 1e-12);
}

TEST(Paths, ATreeWithoutEndEnds) {
  // every hit sends on two rays of its whole weight: 2^64 of them without a bound
  const std::string scene = facing_mirrors(R"("reflection": 1, "refraction": 1, "ior": 1)", 64, 6);
  const Pixel kernel = kernel_pixel(scene, 8);
  EXPECT_LE(kernel.rays, SECONDARY_RAYS_MAX);
  EXPECT_GT(kernel.rays, SECONDARY_RAYS_MAX / 4);
  EXPECT_GT(kernel.dropped, 1);
  const reference::PixelD reference = reference_pixel(scene);
  EXPECT_NEAR(kernel.radiance, reference.radiance.y, 1e-5 * reference.radiance.y);
  EXPECT_NEAR(kernel.dropped, reference.dropped_weight, 1e-5 * reference.dropped_weight);
}

}  // namespace
}  // namespace brume::test
