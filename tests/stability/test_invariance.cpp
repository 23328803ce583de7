// What a picture must not depend on: the run, the batch, the lanes, the threads. Units, shifts and voxel sizes are cases of
// `brume check --stability`, other devices are held against the reference in tests/kernel.
#include <cmath>
#include <cstring>

#include "check/check_images.hpp"
#include "check/check_parts.hpp"
#include "render/program.hpp"
#include "render/renderer.hpp"

namespace brume::test {
namespace {

Context& pocl() {
  static Context context(device_choose("portable computing language"));
  return context;
}

constexpr const char* SCENES[] = {"fog_gauss2",     "fog_jitter", "fog_delta",   "fog_ratio",
                                  "fog_grid_color", "mirrors",    "fog_residual"};

Film film_of(const std::string& name, int lanes, int batch_rays) {
  const PlannedScene scene = check_scene(name, 24, bvh_width_for(lanes));
  Film film({24, 24});
  Renderer renderer(pocl(), scene, {lanes, false, batch_rays});
  renderer.render(film, [](double) { return true; });
  return film;
}

bool same_bits(const Film& a, const Film& b) {
  return std::memcmp(a.pixels().data(), b.pixels().data(), a.pixels().size() * sizeof(FilmPixel)) == 0;
}

TEST(Invariance, BitIdenticalFromRunToRunAndForAnyBatch) {
  for (const char* scene : SCENES) {
    const Film film = film_of(scene, 8, 0);
    EXPECT_TRUE(same_bits(film, film_of(scene, 8, 0))) << scene;
    for (const int batch : {2, 50, 777})
      EXPECT_TRUE(same_bits(film, film_of(scene, 8, batch))) << scene << " " << batch;
  }
}

// Sums are made in another order: rounding is all that may differ, but for the few walks that it sends another way.
TEST(Invariance, LanesOnlyRound) {
  for (const char* scene : SCENES) {
    const Film base = film_of(scene, 1, 0);
    for (const int lanes : {4, 8, 16}) {
      const CheckRow row = film_check(scene, lanes, film_of(scene, lanes, 0), base);
      EXPECT_LE(row.max_error, 2e-5) << scene << " " << lanes;
      EXPECT_LE(row.edges, 1u) << scene << " " << lanes;
    }
  }
}

TEST(Invariance, AnotherSeedIsAnotherPictureOfTheSameMean) {
  PlannedScene scene = check_scene("fog_ratio", 24, 8);
  const Film a = render_film(pocl(), scene, 8);
  scene.frame.seed = 99;
  const Film b = render_film(pocl(), scene, 8);
  EXPECT_FALSE(same_bits(a, b));
  double sum_a = 0, sum_b = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    sum_a += a.pixels()[i].radiance.x;
    sum_b += b.pixels()[i].radiance.x;
  }
  EXPECT_NEAR(sum_a / sum_b, 1, 0.05);
}

using InvarianceOfProgram = Program;

TEST_F(InvarianceOfProgram, ThreadsDoNotMatter) {
  write("fog.json", R"({"film": {"size": [40, 30], "spp": 2},
    "lights": [{"type": "directional", "direction": [-1, -1, -1], "irradiance": [2, 2, 2]}],
    "media": [{"density": {"type": "perlin", "resolution": [20, 20, 20]}, "sigma_s": 3}],
    "render": {"method": "ratio_tracking"}})");
  for (const char* threads : {"1", "2", "5"}) {
    const Outcome r = run(std::string("render fog.json --quiet -o ") + threads + ".exr",
                          std::string("POCL_MAX_PTHREAD_COUNT=") + threads);
    ASSERT_EQ(r.exit_code, 0) << r.err;
  }
  for (const char* other : {"2.exr", "5.exr"}) {
    const Outcome r = run(std::string("compare 1.exr ") + other + " --fail-above 0");
    EXPECT_EQ(r.exit_code, 0) << r.out << r.err;
  }
}

}  // namespace
}  // namespace brume::test
