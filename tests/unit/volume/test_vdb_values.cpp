// How the values of a file become densities: threshold, remap, scale, filled level sets.
#include <cmath>

#include "unit/vdb/vdb_fixture.hpp"
#include "volume/volume_file.hpp"

using namespace brume;
using namespace brume::test;
using testing::HasSubstr;

namespace {

using VdbValues = Vdb;

// Voxels of these values along x, from x = 0 on.
FloatGrid::Ptr row(const std::vector<float>& values, float background = 0) {
  const auto g = FloatGrid::create(background);
  g->setName("density");
  for (std::size_t i = 0; i < values.size(); ++i) g->tree().setValueOn(Coord(int(i), 0, 0), values[i]);
  return g;
}

std::vector<float> densities(const fs::path& file, const VolumeValues& values) {
  const Grid grid = volume_read(file, "", values);
  std::vector<float> read;
  for (int i = 0; i < grid.size().x; ++i) read.push_back(grid.at({i, 0, 0}));
  return read;
}

TEST_F(VdbValues, ScaleMultiplies) {
  VolumeValues values;
  values.scale = 2.5;
  EXPECT_EQ(densities(file({row({1, 2, 0.5f})}), values), (std::vector<float>{2.5f, 5, 1.25f}));
}

TEST_F(VdbValues, ThresholdDropsWhatIsBelow) {
  VolumeValues values;
  values.threshold = 0.5;
  EXPECT_EQ(densities(file({row({0.25f, 0.5f, 1, -3})}), values), (std::vector<float>{0, 0.5f, 1, 0}));
}

TEST_F(VdbValues, RemapIsLinearBetweenItsPairsAndConstantBeyond) {
  VolumeValues values;
  values.remap = {{-1, 0.5}, {1, 0}, {3, 4}};
  EXPECT_EQ(densities(file({row({-9, -1, 0, 1, 2, 3, 7})}), values),
            (std::vector<float>{0.5f, 0.5f, 0.25f, 0, 2, 4, 4}));
}

// Threshold, then remap, then scale: what the threshold drops stays 0.
TEST_F(VdbValues, InTheirOrder) {
  VolumeValues values;
  values.threshold = 1;
  values.remap = {{0, 5}, {2, 1}};
  values.scale = 10;
  EXPECT_EQ(densities(file({row({0.5f, 1, 2})}), values), (std::vector<float>{0, 30, 10}));
}

// As in a scan whose air is -1000: with a remap it is for the scene to say what values mean. Outside of the active
// voxels there is nothing.
TEST_F(VdbValues, RemapAllowsABackground) {
  VolumeValues values;
  values.remap = {{-1000, 0}, {1000, 2}};
  EXPECT_EQ(densities(file({row({0, 500}, -1000)}), values), (std::vector<float>{1, 1.5f}));
  EXPECT_THAT(refusal(file({row({0, 500}, -1000)})), HasSubstr("has the background -1000"));
}

// Values as small and as large as single precision holds keep their ratios.
TEST_F(VdbValues, RemapReachesTheEndsOfFloat) {
  VolumeValues values;
  values.remap = {{0, 0}, {1e-40, 1}};
  EXPECT_NEAR(densities(file({row({0.5e-40f, 1e-40f})}), values)[0], 0.5, 1e-4);
  values.remap = {{0, 0}, {3e38, 1}};
  EXPECT_NEAR(densities(file({row({1.5e38f, 3e38f})}), values)[0], 0.5, 1e-6);
}

// A ball of radius 12 voxels: its volume, in voxels, is 4/3 pi r^3; its diameter is what a line through its middle
// sees.
TEST_F(VdbValues, LevelSetsAreFilled) {
  const double radius = 12, voxel = 0.25;
  const auto ball = FloatGrid::create(float(3 * voxel));
  ball->setGridClass(openvdb::GRID_LEVEL_SET);
  ball->setTransform(openvdb::math::Transform::createLinearTransform(voxel));
  for (int z = -16; z <= 16; ++z)
    for (int y = -16; y <= 16; ++y)
      for (int x = -16; x <= 16; ++x) {
        const double d = std::sqrt(double(x * x + y * y + z * z)) - radius;
        if (std::abs(d) < 3)
          ball->tree().setValueOn(Coord(x, y, z), float(d * voxel));
        else if (d < 0)
          ball->tree().setValueOff(Coord(x, y, z), float(-3 * voxel));
      }
  ball->tree().prune();
  VolumeValues values;
  values.fill = true;
  const Grid grid = volume_read(file({ball}), "", values);
  const GridStats stats = grid_stats(grid);
  EXPECT_EQ(stats.max, 1.0f);
  const double sum = stats.mean * grid.size().x * grid.size().y * grid.size().z;
  EXPECT_NEAR(sum / (4.0 / 3 * M_PI * radius * radius * radius), 1, 0.005);
  double line = 0;
  const ivec3 middle = grid.size() / 2;
  for (int x = 0; x < grid.size().x; ++x) line += grid.at({x, middle.y, middle.z});
  EXPECT_NEAR(line, 2 * radius, 1e-5);
  EXPECT_THAT(refusal(file({ball})), HasSubstr("\"level_set\": \"fill\""));
}

}  // namespace
