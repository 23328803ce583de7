// Every method on every case of `brume check --stability`, one test a case; and that the judgement can fail.
#include <gtest/gtest.h>

#include "stability/stability.hpp"
#include "stability/stability_parts.hpp"

namespace brume {
namespace {

Context& pocl() {
  static Context context(device_choose("portable computing language"));
  return context;
}

class Stability : public testing::TestWithParam<StabilityCase> {};

TEST_P(Stability, EveryMethodHolds) {
  std::size_t rows = 0;
  check_stability(pocl(), {{8}, GetParam().name}, [&](const StabilityRow& row) {
    ++rows;
    EXPECT_TRUE(row.holds) << row.name << ", " << row.method << ", " << row.lanes << " lanes: " << row.remark;
  });
  EXPECT_GE(rows, 5u);
}

INSTANTIATE_TEST_SUITE_P(Case, Stability, testing::ValuesIn(stability_cases()),
                         [](const testing::TestParamInfo<StabilityCase>& test) {
                           return std::string(test.param.name);
                         });

TEST(StabilityLong, EveryLaneWidthHolds) {
  check_stability(pocl(), {{1, 4, 16}, ""}, [](const StabilityRow& row) {
    EXPECT_TRUE(row.holds) << row.name << ", " << row.method << ", " << row.lanes << " lanes: " << row.remark;
  });
}

TEST(StabilityJudgement, SeesWhatIsWrong) {
  StabilityRays rays;
  rays.through({0.1, 0.2, 0}, {0.1, 0, -1});
  StabilityRun run(pocl(), METHOD_DDA_GAUSS2, 8);
  run.compare(run.cube(), rays, 1e-6, true);
  EXPECT_TRUE(run.row().holds) << run.row().remark;

  StabilityRun no_number(pocl(), METHOD_DDA_GAUSS2, 8);
  PlannedScene scene = no_number.cube();
  scene.voxels[0] = NAN;
  for (float& value : scene.voxels) value = NAN;
  no_number.shoot(scene, rays);
  EXPECT_FALSE(no_number.row().holds);

  StabilityRun negative(pocl(), METHOD_DDA_GAUSS2, 8);
  scene = negative.cube();
  for (float& value : scene.voxels) value = -1;
  negative.shoot(scene, rays);
  EXPECT_FALSE(negative.row().holds);

  StabilityRun inexact(pocl(), METHOD_DDA_GAUSS2, 8);
  inexact.compare(inexact.cube(R"({"type": "perlin", "resolution": [8, 8, 8]})"), rays, 1e-12, false);
  EXPECT_FALSE(inexact.row().holds);
}

}  // namespace
}  // namespace brume
