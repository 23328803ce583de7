// Trackers and roulette are right in the mean: a z-test against the exact picture. Many samples of one ray are the
// pixels of a film whose camera is too narrow to tell them apart.
#include <array>
#include <cmath>

#include "physics/closed_form.hpp"

namespace brume::test {
namespace {

constexpr int SIDE = 160;  // SIDE² samples of each ray
constexpr int RAYS = 6;
constexpr int VALUES = 6;  // radiance and transmittance, three channels each

// Two-sided 99.9 % over all the values that one test looks at (Bonferroni): the z with P(|Z| > z) = 0.001 / n.
double z_allowed(int n) {
  double lo = 0, hi = 10;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (lo + hi);
    (std::erfc(middle / std::sqrt(2.0)) > 0.001 / n ? lo : hi) = middle;
  }
  return hi;
}

PlannedScene foggy(const std::string& media, const std::string& render, int ray, int side) {
  const double a = 0.4 + 0.9 * ray;
  char camera[300];
  std::snprintf(camera, sizeof camera,
                R"("camera": {"type": "orthographic", "eye": [%g, %g, %g], "target": [%g, 0.1, %g], "height": 1e-7}, )",
                3 * std::sin(a), 0.5 - 0.2 * ray, 3 * std::cos(a), 0.3 * std::cos(7.0 * ray),
                0.3 * std::sin(5.0 * ray));
  const std::string text = std::string("{") + camera + R"("background": [0.3, 0.2, 0.1], "film": {"size": [)" +
                           std::to_string(side) + ", " + std::to_string(side) + R"(]},
    "lights": [{"type": "directional", "direction": [-0.5, -1, -0.3], "irradiance": [4, 3, 2]},
               {"type": "point", "position": [0.2, 1.5, 0.4], "intensity": [1, 1, 2]}], "media": )" +
                           media + R"(, "render": {"seed": )" + std::to_string(ray) + ", " + render + "}}";
  return flatten(scene_read_text(text, "fog.json", {}), {8, {}});
}

struct Mean {
  double sum = 0, squares = 0;
  void add(double v) {
    sum += v;
    squares += v * v;
  }
  double value(int n) const { return sum / n; }
  double error(int n) const { return std::sqrt(std::max(0.0, squares / n - value(n) * value(n)) / n); }
};

std::array<double, VALUES> values_of(const dvec3& radiance, const dvec3& transmittance) {
  return {radiance.x, radiance.y, radiance.z, transmittance.x, transmittance.y, transmittance.z};
}

std::array<double, VALUES> values_of(const FilmPixel& p) {
  return values_of({p.radiance.x, p.radiance.y, p.radiance.z},
                   {p.transmittance.x, p.transmittance.y, p.transmittance.z});
}

void expect_unbiased(const std::string& media, const std::string& render) {
  const double z_max = z_allowed(RAYS * VALUES);
  for (int ray = 0; ray < RAYS; ++ray) {
    const PlannedScene one = foggy(media, R"("method": "auto")", ray, 1);
    const reference::Context context(one, {8, 1});
    const reference::PixelD exact =
        reference::ray_render(context, reference::camera_ray(one.frame.camera, 0, 0, {0.5, 0.5}));
    const std::array<double, VALUES> expected = values_of(exact.radiance, exact.transmittance);
    const Film film = render_film(pocl(), foggy(media, render, ray, SIDE), 8);
    std::array<Mean, VALUES> means;
    for (const FilmPixel& p : film.pixels())
      for (int k = 0; k < VALUES; ++k) means[k].add(values_of(p)[k]);
    for (int k = 0; k < VALUES; ++k) {
      const int n = SIDE * SIDE;
      // float rounding of what carries no noise at all
      const double error = std::hypot(means[k].error(n), 2e-6 * (expected[k] + 1e-3));
      EXPECT_LE(std::abs(means[k].value(n) - expected[k]) / error, z_max)
          << render << ", ray " << ray << ", value " << k << ": " << means[k].value(n) << " +- " << error
          << " instead of " << expected[k];
    }
  }
}

constexpr const char* COLORED =
    R"([{"density": {"type": "perlin", "resolution": [20, 20, 20], "scale": 3, "octaves": 2, "seed": 3},
  "sigma_a": [0.3, 0.6, 0.1], "sigma_s": [2, 1, 3], "phase": {"type": "henyey_greenstein", "g": 0.5}}])";
constexpr const char* TWO =
    R"([{"density": {"type": "exponential", "resolution": [12, 18, 12]}, "sigma_a": 0.2, "sigma_s": 1,
   "emission": [0.2, 0.1, 0], "transform": [{"rotate": [0, 1, 1, 30]}]},
  {"bounds": [[-0.5, -0.7, -0.6], [1, 0.5, 0.6]], "density": {"type": "sphere", "of": {"type": "linear", "resolution": [17, 17, 17]}},
   "sigma_a": [0.1, 0.5, 0.5], "sigma_s": 0.4, "interpolation": "nearest"},
  {"bounds": [[-0.9, 0, -0.9], [0, 0.9, 0]], "density": {"type": "linear", "resolution": [9, 9, 9]}, "emission": [0, 0.3, 0.6]}])";

TEST(Unbiased, DeltaTracking) {
  expect_unbiased(COLORED, R"("method": "delta_tracking")");
  expect_unbiased(TWO, R"("method": "delta_tracking")");
}

TEST(Unbiased, RatioTracking) {
  expect_unbiased(COLORED, R"("method": "ratio_tracking")");
  expect_unbiased(TWO, R"("method": "ratio_tracking")");
}

TEST(Unbiased, ResidualRatio) {
  expect_unbiased(COLORED, R"("method": "residual_ratio")");
  expect_unbiased(TWO, R"("method": "residual_ratio")");
}

TEST(Unbiased, Roulette) {
  expect_unbiased(COLORED, R"("method": "ratio_tracking", "roulette": 0.6)");
  expect_unbiased(TWO, R"("method": "delta_tracking", "roulette": 0.6)");
}

// The test can fail: a march that is too coarse is found out.
TEST(Unbiased, SeesABias) {
  const PlannedScene scene = foggy(COLORED, R"("method": "march_regular_jitter", "step": 0.5)", 0, SIDE);
  const PlannedScene one = foggy(COLORED, R"("method": "auto")", 0, 1);
  const reference::Context context(one, {8, 1});
  const double exact =
      reference::ray_render(context, reference::camera_ray(one.frame.camera, 0, 0, {0.5, 0.5})).transmittance.x;
  Mean mean;
  const Film film = render_film(pocl(), scene, 8);
  for (const FilmPixel& p : film.pixels()) mean.add(p.transmittance.x);
  EXPECT_GT(std::abs(mean.value(SIDE * SIDE) - exact) / mean.error(SIDE * SIDE), z_allowed(1));
}

}  // namespace
}  // namespace brume::test
