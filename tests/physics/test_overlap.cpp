// Media on one spot: kernels against the reference for every method, and what another medium costs.
#include <string>

#include "physics/closed_form.hpp"
#include "scene/families.hpp"

namespace brume::test {
namespace {

// Perlin boxes about the origin, each turned by 20 degrees against the one before, and `more` media.
std::string boxes_scene(int count, const std::string& medium, const std::string& render, const std::string& more = "") {
  std::string media;
  for (int i = 0; i < count; ++i)
    media += std::string(i ? "," : "") +
             R"({"density": {"type": "perlin", "resolution": [16, 16, 16], "scale": 4, "seed": 2},
                 "transform": [{"rotate": [0, 1, 0, )" +
             std::to_string(20 * i) + R"(]}], )" + medium + "}";
  return R"({"camera": {"eye": [1.7, 1.25, 3.9], "target": [0, 0, 0], "vfov": 40}, "film": {"size": [12, 12]},
    "lights": [{"type": "directional", "direction": [-0.5, -1, -0.3], "irradiance": 3}],
    "media": [)" +
         media + more + R"(], "render": )" + render + "}";
}

PlannedScene flat_of(const std::string& scene, int lanes = 8) {
  return flatten(scene_read_text(scene, "overlap.json", {}), {bvh_width_for(lanes), {}});
}

void expect_as_reference(const std::string& scene, const std::vector<int>& widths, const std::string& where) {
  for (const int lanes : widths) {
    const PlannedScene flat = flat_of(scene, lanes);
    Film expected({flat.frame.camera.width, flat.frame.camera.height}), film = expected;
    reference::render(flat, expected);
    Renderer(pocl(), flat, {lanes, false, 0}).render(film, [](double) { return true; });
    const CheckRow row = film_check(where, lanes, film, expected);
    EXPECT_LE(row.max_error, 1e-4) << where << ", " << lanes << " lanes";
    EXPECT_EQ(row.edges, 0u) << where << ", " << lanes << " lanes";
  }
}

TEST(Overlap, FourTurnedBoxesByEveryMethod) {
  for (const FamilyRow& method : method_family()) {
    if (!(method_fits(method.id) & (FITS_NEAREST | FITS_TRILINEAR))) continue;
    const std::string nearest = method_fits(method.id) & FITS_TRILINEAR ? "" : R"("interpolation": "nearest", )";
    const std::string render = R"({"step": 0.11, "method": ")" + std::string(method.name) + "\"}";
    expect_as_reference(boxes_scene(4, nearest + R"("sigma_a": [0.1, 0.2, 0.3], "sigma_s": 1)", render), {4, 16},
                        std::string(method.name));
  }
}

// A dense medium is cut into parts: others are asked anew inside of its segments.
TEST(Overlap, DenseGlowingBoxesAndAConstantFog) {
  const std::string fog = R"(, {"density": {"type": "constant"}, "bounds": [[-2, -0.4, -2], [2, 0.3, 2]],
                              "sigma_a": 0.3, "sigma_s": 0.7})";
  for (const double sigma : {1e-3, 1.0, 40.0})
    expect_as_reference(
        boxes_scene(2, R"("sigma_s": 0, "emission": [1, 0.5, 0.2], "sigma_a": )" + std::to_string(sigma), "{}", fog),
        {1, 16}, "sigma_a " + std::to_string(sigma));
}

double lookups_of(const PlannedScene& scene) {
  double lookups = 0;
  const Film film = render_film(pocl(), scene, 16);
  for (const FilmPixel& pixel : film.pixels()) lookups += pixel.lookups;
  return lookups;
}

// A segment costs two lookups for its own medium's light and, beside each of the other three, one; the rest is for
// cells that two batches share. Asking at both ends of every segment took 24 times the lookups of one medium.
TEST(Overlap, LookupsOfFourMediaAreBounded) {
  const std::string glow = R"("sigma_a": 0.2, "sigma_s": 0, "emission": 1)";
  const double one = lookups_of(flat_of(boxes_scene(1, glow, "{}"))),
               four = lookups_of(flat_of(boxes_scene(4, glow, "{}")));
  EXPECT_GT(one, 0);
  EXPECT_LE(four, 12 * one);
}

}  // namespace
}  // namespace brume::test
