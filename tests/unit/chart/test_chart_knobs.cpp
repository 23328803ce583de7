// Which settings a chart goes through.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "base/error.hpp"
#include "chart/knobs.hpp"
#include "scene/families.hpp"
#include "scene/scene_reader.hpp"

namespace brume {
namespace {

constexpr KnobLimits VOXELS{64, true};

SceneDesc scene_of(const std::string& density, const std::string& rest = "") {
  return scene_read_text(
      R"({"lights": [{"type": "directional", "direction": [0, -1, 0], "irradiance": 1}],
        "media": [{"density": {"type": ")" +
          density + R"("}, "sigma_s": 1)" + rest + "}]}",
      "knobs.json", {});
}

std::vector<int> all_methods() {
  std::vector<int> all;
  for (const FamilyRow& row : method_family()) all.push_back(row.id);
  return all;
}

TEST(ChartKnobs, NoSettingTwiceAndEveryMethod) {
  const std::vector<Knobs> list = knobs_list(all_methods(), VOXELS, 1);
  std::set<std::string> ids;
  std::set<int> methods;
  for (const Knobs& knobs : list) {
    EXPECT_TRUE(ids.insert(knobs_id(knobs)).second) << knobs_id(knobs);
    methods.insert(knobs.method);
  }
  EXPECT_EQ(methods.size(), std::size_t(METHOD_COUNT));
}

// One method far cheaper than the others does not keep them waiting.
TEST(ChartKnobs, WhateverIsMeasuredFirstThereIsSomethingOfAllMethods) {
  constexpr int SPP = 4;
  std::vector<Knobs> list = knobs_list(all_methods(), VOXELS, SPP);
  const std::vector<Knobs> unordered = list;
  const auto cost = [](const Knobs& knobs) {
    const double finer = (knobs.step > 0 ? 1 / knobs.step : 1) + knobs.light_grid + knobs.spp;
    return knobs.method == METHOD_ADAPTIVE ? 1e-6 * finer : finer;
  };
  knobs_order(list, SPP, cost);
  ASSERT_EQ(list.size(), unordered.size());
  std::set<int> first;
  for (std::size_t i = 0; i < std::size_t(METHOD_COUNT); ++i) {
    EXPECT_TRUE(first.insert(list[i].method).second) << knobs_id(list[i]);
    for (const Knobs& knobs : unordered)
      if (knobs.method == list[i].method && knobs.spp == SPP) {
        EXPECT_LE(cost(list[i]), cost(knobs)) << knobs_id(list[i]) << ' ' << knobs_id(knobs);
      }
  }
  const auto other = [](const Knobs& knobs) { return knobs.spp != SPP; };
  EXPECT_TRUE(std::is_partitioned(list.begin(), list.end(), [&](const Knobs& knobs) { return !other(knobs); }));
  EXPECT_TRUE(std::any_of(list.begin(), list.end(), other));
  std::multiset<std::string> before, after;
  for (const Knobs& knobs : unordered) before.insert(knobs_id(knobs));
  for (const Knobs& knobs : list) after.insert(knobs_id(knobs));
  EXPECT_EQ(before, after);
}

TEST(ChartKnobs, LevelsOfDetailWhereThereIsDetail) {
  const auto levels = [](int cells) {
    std::set<int> found;
    for (const Knobs& knobs : knobs_list(all_methods(), {cells, true}, 1)) {
      found.insert(knobs.level);
      if (knobs.level == 0) continue;
      if (knobs.step > 0) {
        EXPECT_GE(knobs.step * limits_at({cells, true}, knobs.level).cells, 0.25) << knobs_id(knobs);
      }
      EXPECT_NE(method_row(knobs.method).rule, RULE_PRODUCT) << knobs_id(knobs);
      const SceneDesc set = knobs_apply(scene_of("perlin"), knobs);
      EXPECT_EQ(set.render.level, knobs.level);
      EXPECT_EQ(exact_desc(set, 1).render.level, 0);
    }
    return found;
  };
  EXPECT_EQ(levels(0), std::set<int>({0}));
  EXPECT_EQ(levels(30), std::set<int>({0}));
  EXPECT_EQ(levels(32), std::set<int>({0, 1}));
  EXPECT_EQ(levels(64), std::set<int>({0, 1, 2}));
}

TEST(ChartKnobs, EveryKnobIsTurnedWhereItIs) {
  std::set<double> steps;
  std::set<int> grids, storages, rules, spps;
  for (const Knobs& knobs : knobs_list(all_methods(), VOXELS, 1)) {
    const MethodRow row = method_row(knobs.method);
    EXPECT_EQ(knobs.step > 0, row.placement == PLACEMENT_STEPS) << knobs_id(knobs);
    EXPECT_EQ(knobs.tolerance > 0, row.placement == PLACEMENT_PIECES) << knobs_id(knobs);
    if (row.placement == PLACEMENT_COLLISIONS || row.rule == RULE_PRODUCT) {
      EXPECT_EQ(knobs.light_grid, 0);
    }
    if (row.draws == DRAWS_NOTHING) {
      EXPECT_EQ(knobs.spp, 1) << knobs_id(knobs);
    }
    if (knobs.method == METHOD_MARCH_MIDPOINT)
      steps.insert(knobs.step), grids.insert(knobs.light_grid), storages.insert(knobs.storage),
          rules.insert(knobs.rule);
    if (knobs.method == METHOD_RATIO_TRACKING) spps.insert(knobs.spp);
  }
  EXPECT_THAT(steps, testing::ElementsAre(1.0 / 128, 1.0 / 64, 1.0 / 32, 1.0 / 16, 1.0 / 8));  // to half a cell
  EXPECT_THAT(grids, testing::ElementsAre(0, 16, 32, 64, 128));
  EXPECT_EQ(storages.size(), std::size_t(STORAGE_COUNT));
  EXPECT_EQ(rules.size(), std::size_t(IN_SCATTERING_COUNT));
  EXPECT_THAT(spps, testing::ElementsAre(1, 4, 16, 64));
}

TEST(ChartKnobs, WithoutScatteringNoLightGrid) {
  for (const Knobs& knobs : knobs_list(all_methods(), {64, false}, 1)) EXPECT_EQ(knobs.light_grid, 0);
}

TEST(ChartKnobs, WithoutMediaSamplesPerPixel) {
  std::vector<int> spps;
  for (const Knobs& knobs : knobs_list({}, {}, 1)) {
    EXPECT_EQ(knobs.method, METHOD_NONE);
    spps.push_back(knobs.spp);
  }
  EXPECT_THAT(spps, testing::ElementsAre(1, 2, 4, 8, 16, 32, 64));
  EXPECT_EQ(knobs_id({METHOD_NONE, 0, 0, STORAGE_F32, 0, 4}), "none-spp4");
}

TEST(ChartKnobs, AreAppliedToAllMedia) {
  const SceneDesc desc = scene_of("perlin", R"(, "method": "dda_gauss2", "step": 0.5)");
  const SceneDesc set = knobs_apply(desc, {METHOD_MARCH_REGULAR, 0.25, 32, STORAGE_F16, IN_SCATTERING_RECTANGLE, 16});
  EXPECT_FALSE(set.media[0].method || set.media[0].step);
  EXPECT_EQ(set.render.method, METHOD_MARCH_REGULAR);
  EXPECT_EQ(set.render.step, 0.25);
  EXPECT_EQ(set.render.shadow, SHADOW_GRID);
  EXPECT_EQ(set.render.light_grid, 32);
  EXPECT_EQ(set.render.storage, STORAGE_F16);
  EXPECT_EQ(set.render.in_scattering, IN_SCATTERING_RECTANGLE);
  EXPECT_EQ(set.film.spp, 16);
}

TEST(ChartKnobs, MethodsThatFit) {
  const std::vector<int> perlin = methods_fitting(scene_of("perlin"), {});
  EXPECT_EQ(std::count(perlin.begin(), perlin.end(), METHOD_HOMOGENEOUS), 0);
  EXPECT_EQ(std::count(perlin.begin(), perlin.end(), METHOD_DDA_NEAREST), 0);
  EXPECT_EQ(std::count(perlin.begin(), perlin.end(), METHOD_DDA_GAUSS2), 1);
  const std::vector<int> constant = methods_fitting(scene_of("constant"), {});
  EXPECT_EQ(std::count(constant.begin(), constant.end(), METHOD_HOMOGENEOUS), 1);
  EXPECT_THAT(methods_fitting(scene_of("perlin"), methods_parse("ratio_tracking,dda_midpoint")),
              testing::ElementsAre(METHOD_DDA_MIDPOINT, METHOD_RATIO_TRACKING));
  EXPECT_TRUE(methods_fitting(scene_read_text("{}", "empty.json", {}), {}).empty());
}

void expect_refused(const std::function<void()>& call, const std::string& cause) {
  try {
    call();
    ADD_FAILURE() << "not refused: " << cause;
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(cause));
  }
}

TEST(ChartKnobs, RefusesMethods) {
  expect_refused([] { methods_parse("dda_gauss2,march"); }, "--methods: unknown method 'march'; known: dda_nearest, ");
  expect_refused([] { methods_fitting(scene_of("perlin"), {METHOD_HOMOGENEOUS}); },
                 "--methods: 'homogeneous' fits no medium of knobs.json; these do: dda_gauss2, ");
  expect_refused([] { methods_fitting(scene_read_text("{}", "empty.json", {}), {METHOD_DDA_GAUSS2}); },
                 "fits no medium of empty.json, which has none");
}

TEST(ChartKnobs, TheExactPictureLeavesNothingToChance) {
  SceneDesc desc = scene_of("perlin");
  desc.render.method = METHOD_DELTA_TRACKING;
  desc.render.roulette = 0.1;
  desc.render.storage = STORAGE_U8;
  const SceneDesc exact = exact_desc(desc, 4);
  EXPECT_EQ(exact.render.method, METHOD_AUTO);
  EXPECT_EQ(exact.render.shadow, SHADOW_TRACE);
  EXPECT_EQ(exact.render.storage, STORAGE_F32);
  EXPECT_EQ(exact.render.roulette, 0);
  EXPECT_EQ(exact.render.light_picks, 0);
  EXPECT_EQ(exact.film.spp, 4);
  EXPECT_EQ(exact_desc_fine(desc, 4, VOXELS).render.step, 1.0 / 256);
}

}  // namespace
}  // namespace brume
