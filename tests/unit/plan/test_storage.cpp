// Voxels in fewer bytes: how far off they are, and that packed bytes and rounded floats are the same values.
#include <Imath/half.h>
#include <gmock/gmock.h>

#include <cmath>
#include <cstring>

#include "base/error.hpp"
#include "plan/planned_scene.hpp"
#include "scene/scene_reader.hpp"

namespace brume {
namespace {

PlannedScene scene_with(const std::string& storage, const std::string& interpolation = "trilinear",
                        const std::string& density = R"("type": "perlin", "scale": 5)") {
  return flatten(scene_read_text(R"({"media": [{"interpolation": ")" + interpolation + R"(", "density": {)" + density +
                                     R"(, "resolution": [30, 20, 17]}, "sigma_a": 1}], "render": {"storage": ")" +
                                     storage + R"(", "method": "march_midpoint"}})",
                                 "s.json", {}),
                 {});
}

TEST(Storage, FloatsAreAsGiven) {
  const PlannedScene scene = scene_with("f32");
  EXPECT_FALSE(scene.stored);
}

TEST(Storage, HalfIsOffByItsLastDigit) {
  const PlannedScene given = scene_with("f32"), scene = scene_with("f16");
  ASSERT_EQ(scene.stored->packed.size(), 2 * given.voxels.size());
  double worst = 0;
  for (std::size_t i = 0; i < given.voxels.size(); ++i) {
    worst = std::max<double>(worst, std::abs(scene.voxels[i] - given.voxels[i]));
    EXPECT_LE(std::abs(scene.voxels[i] - given.voxels[i]), std::ldexp(given.voxels[i], -11) + 0x1p-25);
    std::uint16_t bits;
    std::memcpy(&bits, &scene.stored->packed[2 * i], 2);
    Imath::half half;
    half.setBits(bits);
    EXPECT_EQ(float(half), scene.voxels[i]);
  }
  EXPECT_GT(worst, 0);
  EXPECT_NEAR(scene.stored->error, worst / *std::max_element(given.voxels.begin(), given.voxels.end()), 1e-7);
}

TEST(Storage, BytesAreOffByHalfAPartOfTheBricksRange) {
  for (const char* interpolation : {"trilinear", "nearest"}) {
    const PlannedScene given = scene_with("f32", interpolation), scene = scene_with("u8", interpolation);
    const int read = scene.placed[0].interpolation == INTERPOLATION_NEAREST ? BRICK_CELLS : BRICK_SAMPLES;
    ASSERT_EQ(scene.stored->packed.size(), given.voxels.size());
    ASSERT_EQ(scene.brick_ranges.size() * BRICK_VALUES, 2 * scene.voxels.size());
    for (std::size_t i = 0; i < scene.brick_ranges.size() / 2; ++i) {
      const float min = scene.brick_ranges[2 * i], max = scene.brick_ranges[2 * i + 1];
      for (int z = 0; z < read; ++z)
        for (int y = 0; y < read; ++y)
          for (int x = 0; x < read; ++x) {
            const std::size_t k = i * BRICK_VALUES + (z * BRICK_SAMPLES + y) * BRICK_SAMPLES + x;
            EXPECT_LE(std::abs(scene.voxels[k] - given.voxels[k]), (max - min) / 510 * 1.001);
            EXPECT_FLOAT_EQ(scene.voxels[k], min + (max - min) * (scene.stored->packed[k] / 255.0f));
          }
    }
    EXPECT_GT(scene.stored->error, 1e-4);
    EXPECT_LT(scene.stored->error, 1.0 / 510);
  }
}

TEST(Storage, ConstantsStayExactInBytes) {
  const PlannedScene scene = scene_with("u8", "nearest", R"("type": "constant", "value": 0.3)");
  EXPECT_EQ(scene.voxels.size(), std::size_t(BRICK_VALUES));
  EXPECT_EQ(scene.voxels[0], 0.3f);
  EXPECT_EQ(scene.stored->error, 0);
}

// Only density times coefficient means anything: densities that half would not hold go into the coefficients.
TEST(Storage, HalfHoldsDensitiesOfAnySize) {
  for (const char* value : {"70000", "1e30", "1e-30", "3e-5"}) {
    const PlannedScene scene = scene_with("f16", "trilinear", R"("type": "constant", "value": )" + std::string(value));
    const MediumBody& m = scene.media[0];
    EXPECT_LE(scene.stored->error, 0x1p-11) << value;
    EXPECT_NEAR(double(scene.voxels[0]) * m.sigma_a.x / std::stod(value), 1, 1e-3) << value;
  }
}

}  // namespace
}  // namespace brume
