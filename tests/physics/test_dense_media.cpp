// Light in media of any optical depth: closed forms of the slab, one medium against two halves of it, light from every
// side.
#include <array>
#include <cmath>
#include <string>

#include "physics/closed_form.hpp"
#include "scene/families.hpp"

namespace brume::test {
namespace {

// A slab of depth 2 and any width, sigma_t times density 1, albedo 0.8, lit at cos = mu by E = 4π and seen along its
// normal: what comes back is 0.8 ∫ σ exp(-σ z (1 + 1/mu)) dz = 0.8 (1 - exp(-2 σ (1 + 1/mu))) / (1 + 1/mu).
double slab_form(double sigma_t, double mu) {
  const double k = 1 + 1 / mu;
  return 0.8 * -std::expm1(-2 * sigma_t * k) / k;
}

std::string slab_scene(const std::string& density, double sigma_t, double mu, const std::string& render,
                       int copies = 1) {
  const auto text = [](double v) {
    char digits[40];
    std::snprintf(digits, sizeof digits, "%.17g", v);
    return std::string(digits);
  };
  std::string media;
  for (int i = 0; i < copies; ++i)
    media += (i ? "," : "") + std::string(R"({"bounds": [[-1000, -1000, -1], [1000, 1000, 1]], "density": )") +
             density + R"(, "sigma_a": )" + text(0.2 * sigma_t / copies) + R"(, "sigma_s": )" +
             text(0.8 * sigma_t / copies) + "}";
  return R"({"camera": {"type": "orthographic", "eye": [0.3, 0.2, 2], "target": [0.3, 0.2, 0], "height": 1},
    "film": {"size": [2, 2]},
    "lights": [{"type": "directional", "direction": [)" +
         text(std::sqrt(1 - mu * mu)) + ", 0, " + text(-mu) + R"(], "irradiance": 12.566370614359172}],
    "media": [)" +
         media + R"(], "render": )" + render + "}";
}

double kernel_pixel(const std::string& scene, int lanes) {
  const PlannedScene flat = flatten(scene_read_text(scene, "slab.json", {}), {bvh_width_for(lanes), {}});
  Film film({2, 2});
  Renderer(pocl(), flat, {lanes, true, 0}).render(film, [](double) { return true; });
  return film.pixels()[1].radiance.y;
}

double reference_pixel(const std::string& scene, int scatter_order = 0, bool ladder = true) {
  PlannedScene flat = flatten(scene_read_text(scene, "slab.json", {}), {4, {}});
  if (!ladder) flat.frame.light_ladder = 0;
  const reference::Context context(flat, {scatter_order, 1});
  return reference::ray_render(context, reference::camera_ray(flat.frame.camera, 1, 0, {0.5, 0.5})).radiance.y;
}

constexpr std::array<double, 7> DEPTHS = {1e-6, 1e-2, 0.7, 5, 60, 1e3, 1e6};

TEST(DenseMedia, ConstantSlabLitFromAnySide) {
  for (const double sigma_t : DEPTHS)
    for (const double mu : {1.0, 0.5, 0.05}) {
      const std::string scene = slab_scene(R"({"type": "constant"})", sigma_t, mu, "{}");
      const std::string where = "sigma_t " + std::to_string(sigma_t) + ", mu " + std::to_string(mu);
      expect_relative(reference_pixel(scene), slab_form(sigma_t, mu), 1e-4, where + ", reference");
      expect_relative(kernel_pixel(scene, 8), slab_form(sigma_t, mu), 1e-4, where + ", kernels");
    }
}

// Every method that is not a tracker, on the same slab as voxels.
TEST(DenseMedia, SlabOfVoxelsByEveryMethod) {
  for (const FamilyRow& method : method_family()) {
    if (method_draws(method.id) == DRAWS_COLLISIONS || !(method_fits(method.id) & (FITS_NEAREST | FITS_TRILINEAR)))
      continue;
    const bool nearest = !(method_fits(method.id) & FITS_TRILINEAR);
    for (const double sigma_t : DEPTHS) {
      std::string scene = slab_scene(R"({"type": "constant", "resolution": [1, 1, 16]})", sigma_t, 1.0,
                                     R"({"step": 0.0001, "method": ")" + std::string(method.name) + "\"}");
      if (nearest) scene.insert(scene.find(R"("density")"), R"("interpolation": "nearest", )");
      const std::string where = std::string(method.name) + ", sigma_t " + std::to_string(sigma_t);
      expect_relative(reference_pixel(scene), slab_form(sigma_t, 1), 2e-3, where + ", reference");
      expect_relative(kernel_pixel(scene, 8), slab_form(sigma_t, 1), 2e-3, where + ", kernels");
    }
  }
}

// Only the product of density and coefficients means anything, in one medium or in several on the same spot.
TEST(DenseMedia, EqualMediaOnOneSpotAreOneOfTheirSum) {
  for (const char* density : {R"({"type": "constant"})", R"({"type": "exponential", "resolution": [4, 4, 8]})"})
    for (const double sigma_t : {1e-3, 1.0, 30.0, 1e4}) {
      const double one = reference_pixel(slab_scene(density, sigma_t, 0.6, "{}", 1));
      for (const int copies : {2, 5}) {
        const std::string scene = slab_scene(density, sigma_t, 0.6, "{}", copies);
        const std::string where =
            std::string(density) + ", sigma_t " + std::to_string(sigma_t) + ", copies " + std::to_string(copies);
        expect_relative(reference_pixel(scene, 0, false), one, 1e-7, where + ", reference");
        expect_relative(reference_pixel(scene), one, 3e-5, where + ", depths to the light between rungs");
        for (const int lanes : {1, 8}) expect_relative(kernel_pixel(scene, lanes), one, 1e-4, where + ", kernels");
      }
    }
}

// Against the exact integral where there is no closed form: a cloud of few, large and dense cells, lit from the side.
TEST(DenseMedia, DenseCloudAgainstTheExactIntegral) {
  for (const double sigma_t : {1.0, 10.0, 100.0, 1e3, 1e5})
    for (const double mu : {1.0, 0.3}) {
      std::string scene = slab_scene(R"({"type": "perlin", "resolution": [6, 6, 12], "scale": 3})", sigma_t, mu, "{}");
      for (std::size_t at; (at = scene.find("1000")) != std::string::npos;) scene.replace(at, 4, "1");
      const double exact = reference_pixel(scene, 8);
      const std::string where = "sigma_t " + std::to_string(sigma_t) + ", mu " + std::to_string(mu);
      expect_relative(reference_pixel(scene), exact, 4e-3, where + ", reference");
      expect_relative(kernel_pixel(scene, 8), exact, 4e-3, where + ", kernels");
    }
}

// A point light in the midst of fog: its depth bends along the view, and its irradiance has a peak.
TEST(DenseMedia, PointLightInFogAgainstTheExactIntegral) {
  for (const double sigma_t : {0.1, 2.0, 20.0}) {
    std::string scene = slab_scene(R"({"type": "constant"})", sigma_t, 1.0, R"({"step": 0.00001})");
    scene.replace(scene.find(R"([{"type": "directional")"),
                  scene.find("],\n    \"media\"") - scene.find(R"([{"type": "directional")"),
                  R"([{"type": "point", "position": [0, 0, 0.4], "intensity": 1})");
    const double exact = reference_pixel(scene, 12);
    const std::string where = "sigma_t " + std::to_string(sigma_t);
    expect_relative(reference_pixel(scene), exact, 1e-3, where + ", reference");
    expect_relative(kernel_pixel(scene, 8), exact, 1e-3, where + ", kernels");
  }
}

// Points of a light grid that lie behind more than any walk goes on to: what is between them and lit ones must not
// depend on where walks ended.
TEST(DenseMedia, CoarseLightGridsAreTheSameForAllLanes) {
  const SceneDesc desc = scene_read_text(R"({"film": {"size": [12, 9]},
    "camera": {"eye": [0.3, 1, 4], "target": [0, 0, 0], "vfov": 14},
    "lights": [{"type": "directional", "direction": [-0.3, -1, -0.4], "irradiance": 3},
               {"type": "point", "position": [1, 1, 0], "intensity": 3}],
    "media": [{"density": {"type": "perlin", "resolution": [24, 24, 24], "scale": 3},
               "bounds": [[-0.4, -0.4, -0.4], [0.4, 0.4, 0.4]], "sigma_a": 200, "sigma_s": 800}],
    "render": {"method": "dda_gauss2", "shadow": "grid", "light_grid": 8}})",
                                         "dense.json", {});
  Film truth({12, 9});
  reference::render(flatten(desc, {4, {}}), truth);
  double sum = 0;
  for (const FilmPixel& p : truth.pixels()) sum += p.radiance.y / double(truth.pixels().size());
  for (const int lanes : {1, 4, 8, 16}) {
    Film film({12, 9});
    const PlannedScene flat = flatten(desc, {bvh_width_for(lanes), {}});
    Renderer(pocl(), flat, {lanes, false, 0}).render(film, [](double) { return true; });
    for (std::size_t i = 0; i < film.pixels().size(); ++i)
      EXPECT_NEAR(film.pixels()[i].radiance.y, truth.pixels()[i].radiance.y, 1e-3 * sum) << lanes << " lanes, " << i;
  }
}

}  // namespace
}  // namespace brume::test
