// Isosurfaces and liquids with a surface in the flat scene.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "flat/flat_scene.hpp"
#include "plan/planned_scene.hpp"
#include "scene/scene_reader.hpp"

namespace brume {
namespace {

PlannedScene flat_of(const std::string& text) { return flatten(scene_read_text(text, "a.json", {}), {4, {}}); }

std::string refusal(const std::string& text) {
  try {
    flat_of(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(FlattenIsosurface, AnIsoThatTheGridNeverReachesIsRefused) {
  EXPECT_EQ(
      refusal(R"({"shapes": [{"type": "isosurface", "iso": 0.75, "density": {"type": "constant", "value": 0.5}}]})"),
      "a.json: /shapes/0/iso: 0.75 is nowhere exceeded, the densities of the grid reach from 0 to 0.5; "
      "expected 0 < iso < 0.5");
  EXPECT_THAT(refusal(R"({"media": [{"type": "liquid", "model": "surface", "iso": 0.5,
                          "density": {"type": "constant", "value": 0.25}}]})"),
              testing::StartsWith("a.json: /media/0/iso: 0.5 is nowhere exceeded"));
}

TEST(FlattenIsosurface, AnIsoThatFloatCannotTellFromAnEndIsRefused) {
  for (const char* iso : {"1e-20", "0.00001", "0.499999"})
    EXPECT_THAT(refusal(std::string(R"({"shapes": [{"type": "isosurface", "iso": )") + iso +
                        R"(, "density": {"type": "constant", "value": 0.5}}]})"),
                testing::HasSubstr("that single precision cannot tell where it is; expected 5e-05 to 0.49995"))
        << iso;
}

TEST(FlattenIsosurface, SharesTheBricksOfAMedium) {
  const char* density = R"({"type": "perlin", "resolution": [20, 20, 20]})";
  const PlannedScene one = flat_of(std::string(R"({"media": [{"sigma_a": 1, "density": )") + density + "}]}");
  const PlannedScene both = flat_of(std::string(R"({"media": [{"sigma_a": 1, "density": )") + density +
                                    R"(}], "shapes": [{"type": "isosurface", "density": )" + density + "}]}");
  EXPECT_EQ(both.voxels.size(), one.voxels.size());
  EXPECT_EQ(both.isosurfaces.at(0).brick_offset, both.grids.at(0).brick_offset);
}

// A density that falls from 1 to 0 over y: half of it lies in one layer of cells.
TEST(FlattenIsosurface, MarksTheCellsThatHoldIso) {
  const PlannedScene scene =
      flat_of(R"({"shapes": [{"type": "isosurface", "density": {"type": "linear", "resolution": [8, 8, 8]}}]})");
  std::size_t marked = 0;
  for (const uint word : scene.iso_masks) marked += static_cast<std::size_t>(__builtin_popcount(word));
  EXPECT_EQ(marked, 16u * 16u);  // of two bricks a side
}

TEST(FlattenIsosurface, WaterIsTheMaterialOfALiquid) {
  const PlannedScene scene = flat_of(R"({"materials": {"oil": {"ior": 1.5, "refraction": 1, "absorption": [0, 1, 0]}},
    "media": [{"type": "liquid", "model": "surface", "density": {"type": "linear"}, "sigma_a": [1, 2, 3]},
              {"type": "liquid", "model": "surface", "density": {"type": "linear"}, "sigma_a": 1, "material": "oil"}]})");
  ASSERT_EQ(scene.shapes.size(), 2u);
  EXPECT_TRUE(scene.media.empty());
  EXPECT_EQ(scene.frame.clear_shadows, 1);
  const Material& water = scene.materials.at(static_cast<std::size_t>(scene.shapes[0].material));
  EXPECT_FLOAT_EQ(water.ior, 1.33f);
  EXPECT_EQ(water.fresnel, 1);
  EXPECT_FLOAT_EQ(water.absorption.z, static_cast<float>(3 * scene.unit));
  const Material& oil = scene.materials.at(static_cast<std::size_t>(scene.shapes[1].material));
  EXPECT_FLOAT_EQ(oil.ior, 1.5f);
  EXPECT_FLOAT_EQ(oil.absorption.y, static_cast<float>(2 * scene.unit));
}

}  // namespace
}  // namespace brume
