// Local lighting against closed forms: a plane boundary at every angle, with and without the correction for grazing
// ones, how it converges behind absorption, and gradients of the presence of a ball.
#include <glm/geometric.hpp>

#include "check/check_parts.hpp"
#include "physics/closed_form.hpp"
#include "reference/liquid.hpp"

namespace brume::test {
namespace {

// E · light_intensity · N·L of liquid_ramp.json, by the direction of the light as it is stored.
double lit(const PlannedScene& scene) {
  return -5 * 0.75 * reference::vec_unit(reference::vec_promote(scene.lights[0].direction)).y;
}

// Cameras that look down and up, from steep to grazing.
const std::vector<std::string> EYES = {"[-0.1, 6, 0.1]", "[-1.5, 4, 0.5]",  "[-3, 2, 0.5]",
                                       "[-6, 1.9, 0.2]", "[-1.5, -2, 0.5]", "[-6, 0.1, 0.2]"};

std::vector<std::string> seen_from(const std::string& eye, std::vector<std::string> overrides = {}) {
  overrides.push_back("/camera/eye=" + eye);
  return overrides;
}

TEST(LiquidForms, ABoundarySendsTheSameAtEveryAngle) {
  const ClosedForm form = [](const PlannedScene& scene, auto&&...) { return lit(scene) / 8; };
  for (const std::string& eye : EYES) {
    expect_closed_form("liquid_ramp.json", form, seen_from(eye));
    for (const char* change : {"/render/step=0.3", "/render/step=0.0007", "/media/0/slices=7", "/media/0/slices=100"})
      expect_closed_form("liquid_ramp.json", form, seen_from(eye, {change}));
  }
}

TEST(LiquidForms, WithoutCorrectionItGrowsWithTheWay) {
  const ClosedForm form = [](const PlannedScene& scene, const reference::RayD& ray) {
    return lit(scene) * 0.25 / std::abs(ray.dir.y) * 8;
  };
  for (const std::string& eye : EYES)
    expect_closed_form("liquid_ramp.json", form, seen_from(eye, {"/media/0/grazing_correction=false"}));
}

// The face at the bottom, too, is in the ambient light; what else there is lies behind it.
TEST(LiquidForms, HighlightAndAmbient) {
  const ClosedForm form = [](const PlannedScene& scene, const reference::RayD& ray) {
    const glm::dvec3 to_light = -reference::vec_unit(reference::vec_promote(scene.lights[0].direction));
    const double lobe = std::pow(glm::normalize(to_light - ray.dir).y, 12.0);
    return (lit(scene) + 5 * 0.25 * lobe) / 8 + 2 * 0.25 * 0.5 / 8;
  };
  expect_closed_form("liquid_ramp.json", form,
                     {"/media/0/specular=0.25", "/media/0/shininess=12", "/media/0/ambient=0.25", "/ambient=0.5"});
}

// Behind absorption: ∫ exp(-σa ∫p) dp over the boundary, and the background through all from there to the bottom.
TEST(LiquidForms, AbsorptionConvergesInSecondOrder) {
  std::vector<double> errors;
  for (const double step : {0.01, 0.005, 0.0025}) {
    const PlannedScene scene =
        scene_flat("liquid_ramp.json", {"/media/0/sigma_a=4", "/render/step=" + std::to_string(step)}, 4);
    const reference::Context context(scene, {0, 1});
    const reference::RayD ray = reference::camera_ray(scene.frame.camera, 1, 1, {0.5, 0.5});
    constexpr int PARTS = 100000;
    double exact = 0;
    for (int i = 0; i < PARTS; ++i) {
      const double p = 0.5 + 0.125 * (i + 0.5) / PARTS;
      exact += lit(scene) / 8 / PARTS * std::exp(-4 * (p * p - 0.25) / std::abs(ray.dir.y));
    }
    errors.push_back(std::abs(reference::ray_render(context, ray).radiance.y / exact - 1));
  }
  EXPECT_LE(errors[0], 1e-2);
  EXPECT_LE(errors[2], errors[0] / 8);
}

// Angle in radians between the normals by stored gradients and those of the ball, at the middle of its boundary.
double normals_off(int resolution, double ramp, const std::string& storage) {
  const PlannedScene scene =
      flatten(scene_read_text(
                  R"({"media": [{"type": "liquid", "density": {"type": "ball", "radius": 0.6, "resolution": [)" +
                      std::to_string(resolution) + "," + std::to_string(resolution) + "," + std::to_string(resolution) +
                      R"(], "ramp": )" + std::to_string(ramp) + R"(}}], "render": {"storage": ")" + storage + "\"}}",
                  "ball.json", {}),
              {4, {}});
  const Medium medium = scene.medium(0);
  const double radius = 0.6 - 0.05 * ramp * 2 / resolution;  // where the presence is 0.55
  CheckRandom random;
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 out = random.direction();
    const glm::dvec3 cell = reference::affine_point(medium.cell_from_world, scene.point(radius * out));
    const glm::dvec3 normal = -reference::presence_gradient(scene, medium, cell);
    worst = std::max(worst, std::acos(std::min(1.0, glm::dot(normal, out) / glm::length(normal))));
  }
  return worst;
}

TEST(LiquidForms, NormalsOfABallAreOfSecondOrder) {
  const double coarse = normals_off(32, 4, "f32"), fine = normals_off(64, 8, "f32");
  EXPECT_LE(coarse, 0.02);
  EXPECT_LE(fine, coarse / 3);
}

TEST(LiquidForms, NormalsInFewerBytes) {
  const double exact = normals_off(64, 4, "f32");
  EXPECT_LE(normals_off(64, 4, "f16"), exact + 1e-3);
  EXPECT_LE(normals_off(64, 4, "u8"), exact + 0.03);
  EXPECT_GE(normals_off(64, 4, "u8"), exact + 1e-3);  // bytes are seen to cost something
}

// Steps so short that float tells no presences apart still have a place of their light.
TEST(LiquidForms, TheShortestStepsAreNumbers) {
  const SceneDesc desc = scene_read_text(R"({"film": {"size": [64, 64]},
    "camera": {"type": "orthographic", "eye": [1.5, 1.2, 3], "height": 2},
    "lights": [{"type": "directional", "direction": [-0.5, -1, -0.6]}],
    "media": [{"type": "liquid", "density": {"type": "ball", "resolution": [32, 32, 32], "ramp": 4}, "sigma_a": 1}],
    "render": {"step": 0.0005}})",
                                         "ball.json", {});
  const PlannedScene scene = flatten(desc, {8, {}});
  Renderer renderer(pocl(), scene, {8, false, 0});
  Film film(desc.film.size);
  renderer.render(film, [](double) { return true; });
  EXPECT_EQ(renderer.stats().invalid_samples, 0);
}

// Time follows the lookups: their number against that of steps has an exponent of 1.
TEST(LiquidForms, LookupsGrowWithSteps) {
  SceneDesc desc = scene_read_text(R"({"film": {"size": [24, 24]}, "camera": {"eye": [1.5, 1.2, 3], "vfov": 36},
    "media": [{"type": "liquid", "density": {"type": "ball", "resolution": [64, 64, 64]}, "sigma_a": 1}]})",
                                   "ball.json", {});
  std::vector<double> lookups;
  for (int k = 8; k <= 10; ++k) {
    desc.render.step = std::exp2(-k);
    const PlannedScene scene = flatten(desc, {8, {}});
    Renderer renderer(pocl(), scene, {8, false, 0});
    Film film(desc.film.size);
    renderer.render(film, [](double) { return true; });
    lookups.push_back(renderer.stats().lookups);
  }
  EXPECT_NEAR(std::log2(lookups[2] / lookups[0]) / 2, 1.0, 0.1) << lookups[0] << " " << lookups[1] << " " << lookups[2];
}

}  // namespace
}  // namespace brume::test
