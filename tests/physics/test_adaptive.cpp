// What `tolerance` means: pictures by `adaptive` are off from the exact integral by less than it, for less work than
// cells take, whatever the media, their number, their depth and their lights.
#include <cmath>
#include <string>

#include "base/statistics.hpp"
#include "physics/closed_form.hpp"

namespace brume::test {
namespace {

const std::string SUN = R"({"type": "directional", "direction": [-0.4, -1, -0.6], "irradiance": 6})";
const std::string SPOT = R"({"type": "spot", "position": [0, 2.2, 0], "direction": [0.1, -1, 0.1], "angle": 15,
                             "softness": 0.3, "intensity": 20})";
const std::string CLOUD = R"("density": {"type": "perlin", "resolution": [40, 40, 40], "scale": 4, "octaves": 2})";
const std::string HAZE = R"("density": {"type": "constant"})";

std::string lit(const std::string& lights, const std::string& media) {
  return R"({"camera": {"eye": [1.7, 1.3, 3.1], "vfov": 36}, "film": {"size": [12, 9]}, "lights": [)" + lights +
         R"(], "media": [)" + media + "]}";
}

struct Picture {
  std::vector<dvec3> pixels;
  double lookups = 0;
};

Picture picture(const std::string& text, const std::vector<std::string>& settings, int scatter_order = 0) {
  const PlannedScene flat = flatten(scene_read_text(text, "adaptive.json", settings), {4, {}});
  const reference::Context context(flat, {scatter_order, 1});
  Picture made;
  for (int y = 0; y < flat.frame.camera.height; ++y)
    for (int x = 0; x < flat.frame.camera.width; ++x) {
      const auto sample = reference::ray_render(context, reference::camera_ray(flat.frame.camera, x, y, {0.5, 0.5}));
      made.pixels.push_back(sample.radiance);
      made.lookups += sample.lookups;
    }
  return made;
}

double rel_rmse(const Picture& a, const Picture& exact) {
  double squares = 0, sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      squares += std::pow(a.pixels[i][c] - exact.pixels[i][c], 2);
      sum += exact.pixels[i][c];
    }
  const auto n = 3.0 * static_cast<double>(a.pixels.size());
  return std::sqrt(squares / n) / (sum / n);
}

Picture adaptive(const std::string& text, const std::string& tolerance) {
  return picture(text, {R"(/render/method="adaptive")", "/render/tolerance=" + tolerance});
}

void expect_within(const std::string& text, const std::vector<std::string>& tolerances = {"0.1", "0.01", "0.001"}) {
  const Picture exact = picture(text, {}, 4);
  double before = INFINITY;
  for (const std::string& tolerance : tolerances) {
    const double error = rel_rmse(adaptive(text, tolerance), exact);
    EXPECT_LT(error, std::stod(tolerance)) << text;
    EXPECT_LT(error, before) << tolerance << " is no closer, of " << text;
    before = error;
  }
}

TEST(Adaptive, ACloudUnderASun) { expect_within(lit(SUN, "{" + CLOUD + R"(, "sigma_a": 0.3, "sigma_s": 2.5})")); }

TEST(Adaptive, ManyDepthsOfACloud) {
  for (const char* sigma : {"1e-6", "0.01", "30", "1000"})
    expect_within(lit(SUN, "{" + CLOUD + R"(, "sigma_a": 0, "sigma_s": )" + sigma + "}"), {"0.1", "0.01"});
}

TEST(Adaptive, ColoursOfExtinction) {
  expect_within(lit(SUN, "{" + CLOUD + R"(, "sigma_a": [0, 1, 5], "sigma_s": [3, 1, 0.2]})"));
}

TEST(Adaptive, SeveralMediaUnderASpot) {
  expect_within(lit(SUN + "," + SPOT, "{" + CLOUD + R"(, "bounds": [[-1, -0.8, -1], [0.5, 0.5, 1]], "sigma_s": 3}, {)" +
                                          HAZE + R"(, "sigma_s": [0.2, 0.3, 0.4]})"),
                {"0.1", "0.01"});
}

TEST(Adaptive, GlowsWithoutLight) {
  expect_within(lit("", "{" + CLOUD + R"(, "sigma_a": 2, "emission": [1, 0.5, 0.2]})"), {"0.1", "0.01"});
}

TEST(Adaptive, TakesFewerLookupsThanCells) {
  const std::string cloud =
      lit(SUN, R"({"density": {"type": "exponential", "resolution": [64, 64, 64]}, "sigma_s": 2})");
  const double cells = picture(cloud, {}).lookups;
  EXPECT_LT(adaptive(cloud, "1e-2").lookups, cells / 16);
  EXPECT_LT(adaptive(cloud, "1e-4").lookups, cells / 4);
}

// So many lamps around the cloud.
std::string lamps(int count, const std::string& intensity) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * M_PI * i / count;
    text += R"(, {"type": "point", "position": [)" + std::to_string(1.8 * std::cos(angle)) + ", 0.4, " +
            std::to_string(1.8 * std::sin(angle)) + R"(], "intensity": )" + intensity + "}";
  }
  return text;
}

TEST(Adaptive, LampsThatHardlyCountAreHardlyAsked) {
  const std::string cloud = "{" + CLOUD + R"(, "sigma_a": 0.3, "sigma_s": 2.5})";
  const double sun = adaptive(lit(SUN, cloud), "0.01").lookups;
  const auto beside = [&](const std::string& intensity) {
    const std::string text = lit(SUN + lamps(24, intensity), cloud);
    const Picture found = adaptive(text, "0.01");
    EXPECT_LT(rel_rmse(found, picture(text, {}, 4)), 0.01) << intensity;
    return found.lookups - sun;
  };
  const double bright = beside("1");
  EXPECT_GT(bright, 12 * sun);
  EXPECT_LT(beside("0.02"), bright / 2);
  EXPECT_LT(beside("0.00001"), sun / 10);
}

TEST(Adaptive, AMediumMayHaveItsOwnTolerance) {
  const std::string medium = "{" + CLOUD + R"(, "sigma_s": 2, "method": "adaptive", "tolerance": 0.001})";
  EXPECT_EQ(picture(lit(SUN, medium), {}).lookups,
            adaptive(lit(SUN, "{" + CLOUD + R"(, "sigma_s": 2})"), "0.001").lookups);
}

// The plane `error` against what is right, over the pixels.
double error_ranked(const std::string& text, const std::vector<std::string>& settings) {
  const PlannedScene flat = flatten(scene_read_text(text, "error.json", settings), {4, {}});
  std::vector<Film> films(2, Film({flat.frame.camera.width, flat.frame.camera.height}));
  reference::render(flat, films[0]);
  reference::render(flat, films[1], {4, 0});
  const std::vector<float> expected = films[0].aov(AOV_ERROR).values;
  const Plane found = films[0].radiance(), exact = films[1].radiance();
  std::vector<double> errors;
  for (std::size_t i = 0; i < expected.size(); ++i)
    errors.push_back(std::abs(found.values[3 * i] - exact.values[3 * i]));
  return rank_correlation({expected.begin(), expected.end()}, errors).value();
}

TEST(Adaptive, PixelsKnowWhichOfThemAreOff) {
  const std::string cloud = lit(SUN, "{" + CLOUD + R"(, "sigma_a": 0.3, "sigma_s": 2.5})");
  for (const char* tolerance : {"0.1", "0.01", "0.001"})
    EXPECT_GT(error_ranked(cloud, {R"(/render/method="adaptive")", std::string("/render/tolerance=") + tolerance,
                                   "/film/size=[24, 18]"}),
              0.4)
        << tolerance;
}

TEST(Adaptive, NoisyPixelsKnowItByTheirSamples) {
  const std::string cloud = lit(SUN, "{" + CLOUD + R"(, "sigma_a": 0.3, "sigma_s": 2.5})");
  EXPECT_GT(error_ranked(cloud, {R"(/render/method="ratio_tracking")", "/film/spp=16", "/film/size=[24, 18]"}), 0.4);
}

TEST(Adaptive, OtherMethodsExpectNothingOfOneSample) {
  const PlannedScene flat =
      flatten(scene_read_text(lit(SUN, "{" + CLOUD + R"(, "sigma_s": 2})"), "none.json", {}), {4, {}});
  Film film({flat.frame.camera.width, flat.frame.camera.height});
  reference::render(flat, film);
  for (const float value : film.aov(AOV_ERROR).values) EXPECT_EQ(value, 0);
}

}  // namespace
}  // namespace brume::test
