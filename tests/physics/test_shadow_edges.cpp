// The rule `gauss2` where light begins, ends or bends within a segment: closed forms of fog behind a board, cells under
// a cone and cells whose light changes faces.
#include <cmath>
#include <string>

#include "physics/closed_form.hpp"

namespace brume::test {
namespace {

// A cube of side 2 seen along -z at x = 0.1, y = 0.2.
struct Cube {
  std::string density = R"({"type": "constant"})", method = "auto", light, shapes, step = "0.05", more;
  double sigma_t = 1;

  PlannedScene flat(int bvh_width) const {
    const std::string medium = R"({"bounds": [[-1, -1, -1], [1, 1, 1]], "density": )" + density + R"(, "sigma_a": )" +
                               number(0.2 * sigma_t) + R"(, "sigma_s": )" + number(0.8 * sigma_t) + "}" + more;
    return flatten(scene_read_text(R"({"camera": {"type": "orthographic", "eye": [0.1, 0.2, 3], "target": [0.1, 0.2, 0],
                                      "height": 1e-6}, "film": {"size": [1, 1]}, "lights": [)" +
                                       light + R"(], "shapes": [)" + shapes + R"(], "media": [)" + medium +
                                       R"(], "render": {"in_scattering": "gauss2", "method": ")" + method +
                                       R"(", "step": )" + step + "}}",
                                   "cube.json", {}),
                   {bvh_width, {}});
  }
  double kernel_pixel(int lanes) const {
    const PlannedScene scene = flat(bvh_width_for(lanes));
    Film film({1, 1});
    Renderer(pocl(), scene, {lanes, true, 0}).render(film, [](double) { return true; });
    return film.pixels()[0].radiance.y;
  }
  double reference_pixel(int scatter_order = 0) const {
    const PlannedScene scene = flat(4);
    return reference::ray_render({scene, {scatter_order, 1}},
                                 reference::camera_ray(scene.frame.camera, 0, 0, {0.5, 0.5}))
        .radiance.y;
  }
};

const std::string ZENITH = R"({"type": "directional", "direction": [0, -1, 0], "irradiance": 1})";

// A board above the cube that keeps the sun from z0 to z1.
std::string board(double z0, double z1) {
  return R"({"type": "quad", "corner": [-9, 1.5, )" + number(z0) + R"(], "u": [18, 0, 0], "v": [0, 0, )" +
         number(z1 - z0) + "]}";
}

// The sun lies at right angles to the ray, 0.8 below the top: 0.8 σ p exp(-0.8 σ) ∫ exp(-σ s) ds over what is lit.
double behind_board(double sigma_t, double z0, double z1) {
  const auto until = [&](double s) { return -std::expm1(-sigma_t * std::clamp(s, 0.0, 2.0)); };
  return 0.8 / (4 * M_PI) * std::exp(-0.8 * sigma_t) * (until(1 - z1) + until(2) - until(1 - z0));
}

TEST(ShadowEdges, FogBehindABoardIsTheClosedForm) {
  for (const auto& [density, method] : {std::pair{R"({"type": "constant"})", "auto"},
                                        std::pair{R"({"type": "constant", "resolution": [1, 1, 8]})", "dda_gauss2"}})
    for (const double sigma_t : {1e-3, 0.5, 4.0})
      for (const auto& [z0, z1] : {std::pair{-0.377, 0.4131}, std::pair{0.311, 0.353}, std::pair{-2.0, 0.77},
                                   std::pair{0.9955, 3.0}, std::pair{-0.9, -0.8777}}) {
        Cube cube;
        cube.density = density;
        cube.method = method;
        cube.sigma_t = sigma_t;
        cube.light = ZENITH;
        cube.shapes = board(z0, z1);
        const std::string where = std::string(method) + ", sigma_t " + number(sigma_t) + ", board from " + number(z0);
        const double form = behind_board(sigma_t, z0, z1);
        if (z1 - z0 > 2.0 / 64) {  // thinner ones may lie between two places that are asked
          expect_relative(cube.reference_pixel(), form, 1e-4, where + ", reference");
          for (const int lanes : {1, 8}) expect_relative(cube.kernel_pixel(lanes), form, 1e-4, where + ", kernels");
        }
        expect_relative(cube.reference_pixel(8), form, 1e-6, where + ", exact");
      }
}

// Its pieces are longer than the cells of the bench: what counts are the edges that it finds between points.
TEST(ShadowEdges, AdaptiveFindsThemBetweenItsPoints) {
  for (const auto& [z0, z1] : {std::pair{-0.377, 0.4131}, std::pair{0.05, 0.35}, std::pair{-2.0, -0.23}}) {
    Cube cube;
    cube.density = R"({"type": "perlin", "resolution": [24, 24, 24], "scale": 2})";
    cube.method = R"(adaptive", "tolerance": 1e-4, "storage": "f32)";
    cube.light = ZENITH;
    cube.shapes = board(z0, z1);
    const std::string where = "board from " + number(z0);
    const double exact = cube.reference_pixel(8);
    expect_relative(cube.reference_pixel(), exact, 1e-3, where + ", reference");
    for (const int lanes : {1, 8}) expect_relative(cube.kernel_pixel(lanes), exact, 1e-3, where + ", kernels");
  }
}

// Parts that stay deep are not cut, whether another medium is tracked or not: what they send is bounded.
TEST(ShadowEdges, DeepPartsSendNoMoreThanWithoutAShadow) {
  for (const std::string& beside : {std::string(), std::string(R"(, {"bounds": [[-3, -1, -1], [-2, 1, 1]],
         "density": {"type": "perlin"}, "method": "delta_tracking", "sigma_s": 1})")}) {
    Cube cube;
    cube.density = R"({"type": "constant", "resolution": [1, 1, 8]})";
    cube.method = "dda_gauss2";
    cube.sigma_t = 4e4;
    cube.light = R"({"type": "directional", "direction": [0, -1, -1], "irradiance": 1})";
    cube.more = beside;
    const double lit = 0.8 / (4 * M_PI) / (1 + std::sqrt(2));  // without a board
    cube.shapes = board(2.3 - 3e-4, 4);                        // keeps the sun from the first 3e-4
    for (const int lanes : {1, 8, 16}) {
      const double value = cube.kernel_pixel(lanes);
      EXPECT_TRUE(value > 0 && value <= 1.01 * lit) << value << " of " << lit << ", " << lanes << " lanes";
    }
  }
}

// A segment that is cut in the same batch as one whose exp(-τ) is none in float.
TEST(ShadowEdges, BesideABlockOfAnyDepth) {
  Cube cube;
  cube.light = ZENITH;
  cube.shapes = board(-0.5, 0.13);
  cube.sigma_t = 0.5;
  cube.more = R"(, {"bounds": [[-1, -1, -1], [1, 1, 0]], "density": {"type": "constant"}, "sigma_s": 1e7})";
  const double expected = cube.reference_pixel();
  EXPECT_GT(expected, 1e-3);
  for (const int lanes : {1, 4, 8, 16})
    expect_relative(cube.kernel_pixel(lanes), expected, 1e-3, std::to_string(lanes) + " lanes");
}

// What a spot sends into cells of an eighth of the cube.
TEST(ShadowEdges, ConeInCells) {
  Cube cube;
  cube.density = R"({"type": "constant", "resolution": [1, 1, 8]})";
  cube.method = "dda_gauss2";
  cube.light = R"({"type": "spot", "position": [0.1, 2.2, 0.03], "direction": [0, -1, 0], "angle": 17,
                   "softness": 0.01, "intensity": 20})";
  const double exact = cube.reference_pixel(8);
  expect_relative(cube.reference_pixel(), exact, 1e-4, "reference");
  for (const int lanes : {1, 8}) expect_relative(cube.kernel_pixel(lanes), exact, 1e-4, "kernels");
}

// Light from the side enters by another face from z = 0.3 on.
TEST(ShadowEdges, FacesOfTheBoxInCells) {
  for (const double sigma_t : {0.1, 1.0, 4.0}) {
    Cube cube;
    cube.density = R"({"type": "constant", "resolution": [1, 1, 8]})";
    cube.method = "dda_gauss2";
    cube.sigma_t = sigma_t;
    cube.light = R"({"type": "directional", "direction": [0, -0.8, -0.7], "irradiance": 1})";
    const double exact = cube.reference_pixel(8);
    expect_relative(cube.reference_pixel(), exact, 1e-5, "sigma_t " + number(sigma_t) + ", reference");
    for (const int lanes : {1, 8}) expect_relative(cube.kernel_pixel(lanes), exact, 2e-5, "kernels");
  }
}

// What glows in one medium is seen through another one that grows otherwise.
TEST(ShadowEdges, GlowBehindAnotherMedium) {
  const std::string text = R"({"camera": {"type": "orthographic", "eye": [0.1, 0.2, 3], "target": [0.1, 0.2, 0],
    "height": 1e-6}, "film": {"size": [1, 1]}, "media": [
    {"bounds": [[-1, -1, -1], [1, 1, 1]], "density": {"type": "perlin", "resolution": [6, 6, 8], "seed": 2},
     "sigma_a": 4, "emission": 3, "emission_density": {"type": "perlin", "resolution": [6, 6, 8], "seed": 5}}],
    "render": {"in_scattering": "gauss2", "method": "auto"}})";
  const auto flat = [&](int width) { return flatten(scene_read_text(text, "glow.json", {}), {width, {}}); };
  const auto reference_pixel = [&](int order) {
    const PlannedScene scene = flat(4);
    return reference::ray_render({scene, {order, 1}}, reference::camera_ray(scene.frame.camera, 0, 0, {0.5, 0.5}))
        .radiance.y;
  };
  const double exact = reference_pixel(8);
  EXPECT_GT(exact, 0.1);
  expect_relative(reference_pixel(0), exact, 1e-4, "reference");
  for (const int lanes : {1, 8}) {
    const PlannedScene scene = flat(bvh_width_for(lanes));
    Film film({1, 1});
    Renderer(pocl(), scene, {lanes, true, 0}).render(film, [](double) { return true; });
    expect_relative(film.pixels()[0].radiance.y, exact, 1e-4, "kernels");
  }
}

}  // namespace
}  // namespace brume::test
