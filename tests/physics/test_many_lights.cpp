// Lights that are chosen: right in the mean, as the reference chooses, and without a number per light and ray in
// memory.
#include <cmath>
#include <random>

#include "physics/closed_form.hpp"

namespace brume::test {
namespace {

// `count` lights of every power over a floor in a fog; the picture asks `samples` of them at each point, 0: all.
std::string scene_of(int count, int samples, int seed, int spp) {
  std::mt19937 random(7);
  const auto uniform = [&](double lo, double hi) {
    return std::to_string(std::uniform_real_distribution<>(lo, hi)(random));
  };
  std::string lights;
  for (int i = 0; i < count; ++i)
    lights += std::string(i ? "," : "") + R"({"type": "point", "position": [)" + uniform(-2, 2) + "," +
              uniform(0.3, 2) + "," + uniform(-2, 2) + R"(], "intensity": )" + uniform(0, 20.0 / count) + "}";
  return R"({"camera": {"eye": [0, 1.5, 5], "target": [0, 0.4, 0], "vfov": 40}, "film": {"size": [8, 8], "spp": )" +
         std::to_string(spp) + R"(}, "lights": [)" + lights + R"(], "materials": {"grey": {"diffuse": 0.8}},
    "shapes": [{"type": "plane", "point": [0, 0, 0], "normal": [0, 1, 0], "material": "grey"},
               {"type": "sphere", "center": [0.4, 0.5, 0], "radius": 0.5, "material": "grey"}],
    "media": [{"density": {"type": "constant"}, "bounds": [[-2, 0, -2], [2, 1, 2]], "sigma_a": 0.02, "sigma_s": 0.1}],
    "render": {"step": 0.2, "light_picks": )" +
         std::to_string(samples) + R"(, "seed": )" + std::to_string(seed) + "}}";
}

PlannedScene flat_of(const std::string& scene) {
  return flatten(scene_read_text(scene, "lights.json", {}), {bvh_width_for(8), {}});
}

Film kernels_render(const PlannedScene& flat) {
  Film film({flat.frame.camera.width, flat.frame.camera.height});
  Renderer(pocl(), flat, {8, false, 0}).render(film, [](double) { return true; });
  return film;
}

double mean_of(const Film& film) {
  double sum = 0;
  for (const float value : film.radiance().values) sum += value;
  return sum / static_cast<double>(film.radiance().values.size());
}

TEST(ManyLights, ChosenOnesAreRightInTheMean) {
  constexpr int RUNS = 24;
  double sum = 0, squares = 0, all = 0;
  for (int seed = 0; seed < RUNS; ++seed) {
    const double whole = mean_of(kernels_render(flat_of(scene_of(40, 0, seed, 4))));
    const double off = mean_of(kernels_render(flat_of(scene_of(40, 3, seed, 4)))) - whole;
    all += whole / RUNS;
    sum += off / RUNS;
    squares += off * off / RUNS;
  }
  const double error = std::sqrt((squares - sum * sum) / (RUNS - 1));
  EXPECT_GT(error, 1e-4 * all) << "no light was chosen";
  EXPECT_LT(std::abs(sum), 4 * error);
  EXPECT_LT(std::abs(sum), 0.1 * all);
}

TEST(ManyLights, TheReferenceChoosesTheSame) {
  const PlannedScene flat = flat_of(scene_of(300, 5, 1, 2));
  ASSERT_EQ(flat.frame.light_picks, 5);
  Film expected({8, 8});
  reference::render(flat, expected);
  const CheckRow row = film_check("lights", 8, kernels_render(flat), expected);
  EXPECT_LE(row.max_error, 1e-4);
  EXPECT_LE(row.edges, 1u);
}

TEST(ManyLights, UpTo256AreAllAsked) {
  const auto picks = [](int lights, int samples) {
    std::string scene = scene_of(lights, samples, 0, 1);
    if (samples < 0) scene.replace(scene.find(R"("light_picks": -1, )"), 19, "");
    return flat_of(scene).frame.light_picks;
  };
  EXPECT_EQ(picks(256, -1), 256);
  EXPECT_EQ(picks(257, -1), 32);
  EXPECT_EQ(picks(257, 0), 257);
  EXPECT_EQ(picks(3, 7), 3);
}

}  // namespace
}  // namespace brume::test
