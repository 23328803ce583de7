// How finely the plan lets `adaptive` walk each brick.
#include <gmock/gmock.h>

#include <algorithm>

#include "plan/planned_scene.hpp"
#include "scene/scene_reader.hpp"

namespace brume::test {
namespace {

PlannedScene planned(const std::string& density, double tolerance, const std::string& medium = "") {
  const std::string text = R"({"media": [{"density": )" + density + R"(, "sigma_s": 1)" + medium +
                           R"(}], "render": {"method": "adaptive", "tolerance": )" + std::to_string(tolerance) + "}}";
  return flatten(scene_read_text(text, "rates.json", {}), {4, {}});
}

double walked_by_cells(const PlannedScene& scene) {
  double cells = 0;
  for (std::size_t i = 0; i < scene.piece_rates.size(); i += PIECE_ROW)
    cells += scene.piece_rates[i] == PIECE_RATE_CELLS;
  return cells * PIECE_ROW / double(scene.piece_rates.size());
}

const char* const SMOOTH = R"({"type": "linear", "resolution": [32, 32, 32]})";
const char* const ROUGH = R"({"type": "perlin", "resolution": [32, 32, 32], "scale": 16, "octaves": 4})";

// At its border a ramp goes on as it ends, a bend that takes some pieces more.
TEST(PieceRates, ARampTakesFewPiecesABrick) {
  const PlannedScene scene = planned(SMOOTH, 1e-3);
  ASSERT_EQ(scene.piece_rates.size(), PIECE_ROW * scene.voxels.size() / BRICK_VALUES);
  float least = PIECE_RATE_CELLS;
  for (std::size_t i = 0; i < scene.piece_rates.size(); i += PIECE_ROW) {
    least = std::min(least, scene.piece_rates[i]);
    EXPECT_LE(scene.piece_rates[i], 0.5f);
  }
  EXPECT_EQ(least, 0.125f);
}

TEST(PieceRates, NoiseIsWalkedByItsCells) {
  EXPECT_GT(walked_by_cells(planned(ROUGH, 1e-5)), 0.9);  // but for those on the border that hold hardly any
}

TEST(PieceRates, NeverFinerWithMoreToleranceNorToLights) {
  PlannedScene fine = planned(ROUGH, 1e-4);
  for (const double tolerance : {1e-3, 1e-2, 1e-1, 1.0}) {
    const PlannedScene coarse = planned(ROUGH, tolerance);
    for (std::size_t i = 0; i < fine.piece_rates.size(); i += PIECE_ROW) {
      EXPECT_LE(coarse.piece_rates[i], fine.piece_rates[i]);
      EXPECT_LE(coarse.piece_rates[i + PIECE_LIGHT], coarse.piece_rates[i]);
      EXPECT_GE(coarse.piece_rates[i + PIECE_ROUGH], fine.piece_rates[i + PIECE_ROUGH]);
      EXPECT_EQ(coarse.piece_rates[i + PIECE_ROUGH] > 0 && coarse.piece_rates[i] == PIECE_RATE_CELLS, false);
    }
    EXPECT_NE(coarse.piece_rates, fine.piece_rates) << tolerance;
    fine = coarse;
  }
}

TEST(PieceRates, ThinAndDenseMediaAreHeldToTheirOwnLight) {
  const std::vector<float> thin = planned(ROUGH, 1e-2, R"(, "sigma_a": 1e-6)").piece_rates;
  EXPECT_EQ(planned(ROUGH, 1e-2).piece_rates, thin);  // 1/σt does not count there
  EXPECT_GT(walked_by_cells(planned(ROUGH, 1e-2, R"(, "sigma_a": 1e6)")), 0.9);
}

TEST(PieceRates, VoxelsOfNearestAreSeenAsSteps) {
  const std::string nearest = R"(, "interpolation": "nearest")";
  EXPECT_GT(walked_by_cells(planned(ROUGH, 1e-2, nearest)), walked_by_cells(planned(ROUGH, 1e-2)));
}

TEST(PieceRates, ConstantDensitiesHaveNone) {
  const PlannedScene scene = planned(R"({"type": "sphere", "of": {"type": "constant"}})", 1e-4);
  EXPECT_TRUE(scene.piece_rates.empty());
  EXPECT_TRUE(scene.medium(0).is_constant);
  EXPECT_FLOAT_EQ(scene.walks[0].step, 0.1f * static_cast<float>(scene.sizes[0].longest));
}

}  // namespace
}  // namespace brume::test
