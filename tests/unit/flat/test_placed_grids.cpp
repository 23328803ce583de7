// Which media share the bricks of a grid.
#include "plan/planned_scene.hpp"
#include "unit/flat/brick_definition.hpp"

namespace brume {
namespace {

using namespace test;

// The same density is stored once, wherever media show it; another interpolation pads it in another way.
TEST(PlacedGrids, MediaOfOneDensityShareThem) {
  SceneDesc desc = scene_with(generator("perlin", {9, 10, 11}), INTERPOLATION_TRILINEAR);
  desc.media.push_back(desc.media[0]);
  desc.media[1].transform = {Translate{dvec3(3, 0, 0)}};
  desc.media[1].sigma_s = dvec3(2);
  const PlannedScene one = flatten(scene_with(desc.media[0].density, INTERPOLATION_TRILINEAR), {});
  const PlannedScene two = flatten(desc, {});
  EXPECT_EQ(two.grids.size(), 1u);
  EXPECT_EQ(two.placed.size(), 2u);
  EXPECT_EQ(two.voxels, one.voxels);
  EXPECT_EQ(two.bricks, one.bricks);
  EXPECT_EQ(two.media[1].sigma_s.x, 2 * static_cast<float>(two.unit));
  EXPECT_NE(two.medium(0).world_from_cell.m[3], two.medium(1).world_from_cell.m[3]);
  desc.media[1].interpolation = INTERPOLATION_NEAREST;
  const PlannedScene padded = flatten(desc, {});
  EXPECT_EQ(padded.grids.size(), 2u);
  for (int i : {0, 1}) expect_bricks_of(grid_of(desc.media[i].density), padded, padded.medium(i));
}

// A glow with a density of its own is a row that emits and nothing else.
TEST(PlacedGrids, AGlowOfItsOwnNamesItsGrid) {
  SceneDesc desc = scene_with(generator("perlin", {9, 10, 11}), INTERPOLATION_TRILINEAR);
  desc.media[0].emission = dvec3(1);
  const PlannedScene own = flatten(desc, {});
  ASSERT_EQ(own.media.size(), 1u);
  EXPECT_EQ(own.media[0].density, 0);
  EXPECT_EQ(own.media[0].glow, 0);
  desc.media[0].emission_density = std::make_shared<DensityDesc>(generator("linear", {20, 5, 8}));
  const PlannedScene two = flatten(desc, {});
  ASSERT_EQ(two.media.size(), 2u);
  EXPECT_EQ(two.media[0].density, -1);
  EXPECT_EQ(two.media[0].glow, 0);
  EXPECT_EQ(two.media[1].density, 1);
  EXPECT_EQ(two.media[1].glow, -1);
}

}  // namespace
}  // namespace brume
