// The rule `gauss2`: closed forms of a slab at any depth, exact integrals of fog under every kind of light, and the
// order by which its error falls.
#include <cmath>
#include <string>

#include "physics/closed_form.hpp"

namespace brume::test {
namespace {

struct Fog {
  std::string bounds = "[[-1, -1, -1], [1, 1, 1]]", density = R"({"type": "constant"})", light;
  double sigma_t = 1;
  std::string eye = "[1.7, 1.3, 3.1]", target = "[0.1, -0.15, 0.05]", rule = "gauss2", method = "auto", step = "0.05";

  std::string scene() const {
    const std::string medium = R"({"bounds": )" + bounds + R"(, "density": )" + density + R"(, "sigma_a": )" +
                               number(0.2 * sigma_t) + R"(, "sigma_s": )" + number(0.8 * sigma_t) +
                               R"(, "phase": {"type": "henyey_greenstein", "g": 0.3}})";
    return R"({"camera": {"type": "orthographic", "eye": )" + eye + R"(, "target": )" + target +
           R"(, "height": 0.5}, "film": {"size": [2, 2]}, "lights": [)" + light + R"(], "media": [)" + medium +
           R"(], "render": {"in_scattering": ")" + rule + R"(", "method": ")" + method + R"(", "step": )" + step + "}}";
  }
  double kernel_pixel(int lanes) const {
    const PlannedScene flat = flatten(scene_read_text(scene(), "fog.json", {}), {bvh_width_for(lanes), {}});
    Film film({2, 2});
    Renderer(pocl(), flat, {lanes, true, 0}).render(film, [](double) { return true; });
    return film.pixels()[1].radiance.y;
  }
  double reference_pixel(int scatter_order = 0) const {
    const PlannedScene flat = flatten(scene_read_text(scene(), "fog.json", {}), {4, {}});
    const reference::Context context(flat, {scatter_order, 1});
    return reference::ray_render(context, reference::camera_ray(flat.frame.camera, 1, 0, {0.5, 0.5})).radiance.y;
  }
  double exact_pixel() const {
    Fog fine = *this;
    if (density.find("constant") != std::string::npos) fine.step = "0.0005";
    return fine.reference_pixel(8);
  }
};

const std::string SUN = R"({"type": "directional", "direction": [-0.4, -1, -0.6], "irradiance": 6})";
const std::string LAMP_BESIDE = R"({"type": "point", "position": [2, 2.5, 1.2], "intensity": 20})";
const std::string LAMP_INSIDE = R"({"type": "point", "position": [0.3, 0.2, 0.1], "intensity": 1})";
const std::string SPOT = R"({"type": "spot", "position": [0, 2.2, 0], "direction": [0.1, -1, 0.1], "angle": 15,
                             "softness": 0.3, "intensity": 20})";

// What witnesses are asked: whatever the steps of the picture. A ray at a distance d from a lamp in thin fog sees
// σs I p (atan(s₁/d) - atan(s₀/d)) / d.
TEST(ExactIntegral, PassesALampAtAnyDistance) {
  for (const double d : {0.3, 1e-2, 1e-4})
    for (const char* step : {"0.5", "0.01"}) {
      Fog fog;
      fog.sigma_t = 1e-7;
      fog.eye = "[" + number(0.3 + d) + ", 0.2, 3]";
      fog.target = "[" + number(0.3 + d) + ", 0.2, 0]";
      fog.light = R"({"type": "point", "position": [0.3, 0.2, 0.1], "intensity": 1})";
      fog.step = step;
      const PlannedScene flat = flatten(scene_read_text(fog.scene(), "fog.json", {}), {4, {}});
      const reference::Context context(flat, {3, 1});
      reference::RayD ray = reference::camera_ray(flat.frame.camera, 1, 0, {0, 1});  // the middle of the picture
      const double value = reference::ray_render(context, ray).radiance.y;
      // g = 0.3, cos = the angle between the way from the lamp and -dir
      const auto phase = [](double cosine) { return 0.91 / (4 * M_PI * std::pow(1.09 - 0.6 * cosine, 1.5)); };
      double expected = 0;  // ∫ p dθ / d, θ = atan(s / d), evenly in θ
      const double from = std::atan(-0.9 / d), until = std::atan(1.1 / d);
      constexpr int COUNT = 20000;
      for (int i = 0; i < COUNT; ++i) {
        const double theta = from + (until - from) * (i + 0.5) / COUNT;
        expected += 0.8e-7 / d * phase(-std::sin(theta)) * (until - from) / COUNT;
      }
      EXPECT_NEAR(value / expected, 1, 1e-3) << d << " step " << step;
    }
}

// A slab of depth 2 and any width seen along its normal, lit at cos = mu by E: 0.8 E p ∫ σ exp(-σ z (1 + 1/mu)) dz.
TEST(TwoPoints, ConstantSlabAtAnyDepth) {
  for (const double sigma_t : {1e-6, 1e-2, 0.7, 5.0, 60.0, 1e3, 1e6})
    for (const double mu : {1.0, 0.5, 0.05}) {
      Fog fog;
      fog.bounds = "[[-1000, -1000, -1], [1000, 1000, 1]]";
      fog.eye = "[0.3, 0.2, 2]";
      fog.target = "[0.3, 0.2, 0]";
      fog.sigma_t = sigma_t;
      fog.light = R"({"type": "directional", "direction": [)" + number(std::sqrt(1 - mu * mu)) + ", 0, " + number(-mu) +
                  R"(], "irradiance": 1})";
      const double k = 1 + 1 / mu, g = 0.3, pi = 3.14159265358979323846;
      const double phase = (1 - g * g) / (4 * pi * std::pow(1 + g * g + 2 * g * mu, 1.5));
      const double form = 0.8 * phase * -std::expm1(-2 * sigma_t * k) / k;
      const std::string where = "sigma_t " + number(sigma_t) + ", mu " + number(mu);
      expect_relative(fog.reference_pixel(), form, 1e-6, where + ", reference");
      if (sigma_t < 1e4) expect_relative(fog.kernel_pixel(8), form, sigma_t < 10 ? 1e-5 : 1e-4, where + ", kernels");
    }
}

// With the steps of a scene that asks for nothing. A lamp beside the plane of a face makes depths bend most.
TEST(TwoPoints, FogUnderEveryLightAgainstTheExactIntegral) {
  for (const std::string& light : {SUN, LAMP_BESIDE, LAMP_INSIDE, SPOT})
    for (const double sigma_t : {1e-3, 0.3, 3.0}) {
      Fog fog;
      fog.sigma_t = sigma_t;
      fog.light = light;
      const double exact = fog.exact_pixel(), limit = light == LAMP_BESIDE ? 1e-4 : 1e-5;
      const std::string where = light + ", sigma_t " + number(sigma_t);
      expect_relative(fog.reference_pixel(), exact, limit, where + ", reference");
      for (const int lanes : {1, 8}) expect_relative(fog.kernel_pixel(lanes), exact, 2 * limit, where + ", kernels");
    }
}

// A cloud of few, large and dense cells.
// Cells of half the medium, a lamp in one of them and the ray close by.
TEST(TwoPoints, LampWithinLargeCells) {
  for (const char* target : {"[0.3, 0.21, 0.1]", "[0.3, 0.3, 0.1]", "[0.1, -0.15, 0.05]"}) {
    Fog fog;
    fog.density = R"({"type": "exponential", "resolution": [2, 4, 2]})";
    fog.light = LAMP_INSIDE;
    fog.target = target;
    const double exact = fog.exact_pixel();
    EXPECT_NEAR(fog.reference_pixel() / exact, 1, 1e-3) << target;
    for (const int lanes : {1, 8}) EXPECT_NEAR(fog.kernel_pixel(lanes) / exact, 1, 1e-3) << target;
  }
}

TEST(TwoPoints, DenseCloudAgainstTheExactIntegral) {
  for (const double sigma_t : {1.0, 10.0, 100.0, 1e3}) {
    Fog cloud;
    cloud.density = R"({"type": "perlin", "resolution": [6, 6, 12], "scale": 3})";
    cloud.sigma_t = sigma_t;
    cloud.light = SUN;
    const double exact = cloud.exact_pixel();
    const std::string where = "sigma_t " + number(sigma_t);
    expect_relative(cloud.reference_pixel(), exact, 1e-3, where + ", reference");
    expect_relative(cloud.kernel_pixel(8), exact, 1e-3, where + ", kernels");
  }
}

// Twice as many cells of one smooth density: a sixteenth of the error, of `segment` a quarter.
TEST(TwoPoints, ErrorFallsWithTheFourthPowerOfTheCells) {
  const auto error = [](const std::string& rule, int cells) {
    Fog fog;
    fog.density = R"({"type": "constant", "resolution": [1, 1, )" + std::to_string(cells) + "]}";
    fog.sigma_t = 0.5;
    fog.light = R"({"type": "point", "position": [0.6, 0.1, 3], "intensity": 20})";  // always through one face
    fog.eye = "[0.1, 0.2, 3]";
    fog.target = "[0.1, 0.2, 0]";
    fog.rule = rule;
    fog.method = "dda_gauss2";
    const double exact = fog.reference_pixel(12);
    return std::abs(fog.reference_pixel() / exact - 1);
  };
  EXPECT_GT(error("gauss2", 4) / error("gauss2", 8), 11);
  EXPECT_GT(error("gauss2", 8) / error("gauss2", 16), 11);
  EXPECT_LT(error("segment", 4) / error("segment", 8), 6);
}

}  // namespace
}  // namespace brume::test
