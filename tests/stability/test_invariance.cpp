// What a picture must not depend on: the run, the batch, the lanes, the threads, the work list that it is made by.
// Units, shifts and voxel sizes are cases of `brume check --stability`, other devices are held against the reference in
// tests/kernel.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/error.hpp"
#include "check/check_images.hpp"
#include "check/check_parts.hpp"
#include "reference/render.hpp"
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

// Every pixel of a 24 x 24 film, these samples of each.
WorkList samples_of_all(std::uint32_t first, std::uint32_t samples) {
  WorkList list;
  for (std::uint32_t pixel = 0; pixel < 24 * 24; ++pixel) list.push_back({pixel, first, samples});
  return list;
}

PlannedScene scene_of_8_samples(const char* name) {
  PlannedScene scene = check_scene(name, 24, 8);
  scene.frame.camera.spp = 8;
  return scene;
}

// Films of several lists, each list rendered on top of what the film holds.
Film film_of_lists(const PlannedScene& scene, const std::vector<WorkList>& lists, int batch_rays = 0) {
  Renderer renderer(pocl(), scene, {8, false, batch_rays});
  Film film({24, 24});
  for (const WorkList& list : lists) {
    double rays = 0;
    for (const PixelWork& work : list) rays += work.samples;
    EXPECT_TRUE(renderer.render(film, list, [](double) { return true; }));
    EXPECT_EQ(renderer.stats().primary_rays, rays);
  }
  return film;
}

TEST(WorkLists, InAnyOrderAndPiecesGiveTheSameBits) {
  for (const char* name : {"fog_delta", "mirrors"}) {
    const PlannedScene scene = scene_of_8_samples(name);
    const Film whole = film_of_lists(scene, {work_all(scene.frame)});
    const WorkList early = samples_of_all(0, 3), late = samples_of_all(3, 5);
    EXPECT_TRUE(same_bits(whole, film_of_lists(scene, {early, late}))) << name;
    WorkList mixed;  // of each pixel its samples in order, by pieces, pixels backwards
    for (std::size_t i = early.size(); i-- > 0;) mixed.insert(mixed.end(), {early[i], late[i]});
    EXPECT_TRUE(same_bits(whole, film_of_lists(scene, {mixed}))) << name;
    WorkList backwards = work_all(scene.frame);
    std::reverse(backwards.begin(), backwards.end());
    for (const int batch : {5, 77, 0}) EXPECT_TRUE(same_bits(whole, film_of_lists(scene, {backwards}, batch))) << name;
  }
}

TEST(WorkLists, MergedFilmsAreTheWholeFilm) {
  const PlannedScene scene = scene_of_8_samples("fog_delta");
  const Film whole = film_of_lists(scene, {work_all(scene.frame)});
  Film early = film_of_lists(scene, {samples_of_all(0, 4)});
  const Film late = film_of_lists(scene, {samples_of_all(4, 4)});
  WorkList odd, even;
  for (const PixelWork& work : work_all(scene.frame)) (work.pixel % 2 == 0 ? even : odd).push_back(work);
  Film disjoint = film_of_lists(scene, {odd});
  const Film others = film_of_lists(scene, {even});
  double spread = 0;
  for (std::size_t i = 0; i < whole.pixels().size(); ++i) {
    film_pixel_merge(early.pixels()[i], late.pixels()[i]);
    film_pixel_merge(disjoint.pixels()[i], others.pixels()[i]);
    const FilmPixel &p = early.pixels()[i], &q = whole.pixels()[i];
    ASSERT_EQ(p.samples, 8);
    ASSERT_EQ(p.key, q.key);
    ASSERT_NEAR(p.radiance.y, q.radiance.y, 1e-6 * q.radiance.y);
    ASSERT_NEAR(p.squares.y, q.squares.y, 1e-5 * q.squares.y + 1e-12);
    spread += q.squares.y;
  }
  EXPECT_GT(spread, 0.1);
  EXPECT_TRUE(same_bits(disjoint, whole));
}

TEST(WorkLists, OutsideOfTheFilmAreRefused) {
  const PlannedScene scene = scene_of_8_samples("fog_delta");
  Renderer renderer(pocl(), scene, {8, false, 0});
  Film film({24, 24}), other({24, 23});
  EXPECT_THROW(renderer.render(film, {{24 * 24, 0, 1}}, [](double) { return true; }), RuntimeError);
  EXPECT_THROW(renderer.render(other, {{0, 0, 1}}, [](double) { return true; }), RuntimeError);
}

// Stopped after any batch, a film holds whole samples, and going on makes it the film of one go.
TEST(WorkLists, GoOnAfterAStop) {
  const PlannedScene scene = scene_of_8_samples("fog_delta");
  const Film whole = film_of_lists(scene, {work_all(scene.frame)});
  Renderer renderer(pocl(), scene, {8, false, 50});
  Film film({24, 24});
  int batches = 0;
  EXPECT_FALSE(renderer.render(film, [&](double) { return ++batches < 9; }));
  WorkList rest;
  double done = 0;
  for (std::uint32_t pixel = 0; pixel < 24 * 24; ++pixel) {
    const auto has = static_cast<std::uint32_t>(film.pixels()[pixel].samples + film.pixels()[pixel].invalid);
    done += has;
    rest.push_back({pixel, has, 8 - has});
  }
  EXPECT_EQ(renderer.stats().primary_rays, done);
  EXPECT_TRUE(renderer.render(film, rest, [](double) { return true; }));
  EXPECT_TRUE(same_bits(film, whole));
}

TEST(Variance, IsThatOfTheReference) {
  for (const char* name : {"fog_delta", "mesh", "surfaces"}) {
    const PlannedScene scene = scene_of_8_samples(name);
    const Film film = film_of_lists(scene, {work_all(scene.frame)});
    Film exact({24, 24});
    reference::render(scene, exact);
    const std::vector<float> found = film.aov(AOV_VARIANCE).values, expected = exact.aov(AOV_VARIANCE).values;
    std::size_t edges = 0, noisy = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const FilmPixel &p = film.pixels()[i / 3], &q = exact.pixels()[i / 3];
      noisy += expected[i] > 1e-6f;
      if (p.key != q.key)
        ++edges;
      else
        ASSERT_NEAR(found[i], expected[i], 2e-4 * expected[i] + 1e-8) << name << " value " << i;
    }
    EXPECT_LE(edges, 12u) << name;
    EXPECT_GT(noisy, 300u) << name;
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
