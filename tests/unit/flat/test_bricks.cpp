// Grids as bricks (layout: shared/medium.h), through flatten() and so with generators and OpenVDB files as they come:
// every sample, entry and range against the grid itself.
#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <map>
#include <random>
#include <set>

#include "flat/flatten_parts.hpp"
#include "plan/planned_scene.hpp"
#include "unit/flat/brick_definition.hpp"
#include "unit/vdb/vdb_fixture.hpp"
#include "volume/density_source.hpp"

namespace brume {
namespace {

using namespace test;

// How often each entry occurs among the bricks of a grid.
std::map<int, int> entries_of(const FlatScene& scene, const Medium& m) {
  std::map<int, int> uses;
  for_each({m.brick_nx, m.brick_ny, m.brick_nz}, [&](ivec3 b) { ++uses[brick_number(scene, m, b)]; });
  return uses;
}

TEST(Bricks, OfGenerators) {
  for (const int interpolation : {INTERPOLATION_NEAREST, INTERPOLATION_TRILINEAR})
    for (const ivec3 size : {ivec3(1), ivec3(7, 8, 9), ivec3(16, 15, 17), ivec3(3, 30, 24)})
      for (const char* type : {"linear", "perlin", "exponential"}) {
        SCOPED_TRACE(std::string(type) + " " + std::to_string(size.x) + " " + std::to_string(interpolation));
        const DensityDesc density = generator(type, size);
        const PlannedScene scene = flatten(scene_with(density, interpolation), {});
        ASSERT_EQ(scene.media.size(), 1u);
        expect_bricks_of(grid_of(density), scene, scene.medium(0));
      }
}

// A ball in a cube: its corners are empty bricks.
TEST(Bricks, EmptyOnesAreNotStored) {
  DensityDesc ball = generator("sphere", ivec3(64));
  ball.of = std::make_shared<DensityDesc>(generator("perlin", ivec3(64)));
  for (const int interpolation : {INTERPOLATION_NEAREST, INTERPOLATION_TRILINEAR}) {
    const PlannedScene scene = flatten(scene_with(ball, interpolation), {});
    const Grid grid = grid_of(ball);
    expect_bricks_of(grid, scene, scene.medium(0));
    const std::map<int, int> uses = entries_of(scene, scene.medium(0));
    EXPECT_GE(uses.at(BRICK_EMPTY), 8);
    EXPECT_EQ(scene.voxels.size(), (uses.size() - 1) * BRICK_VALUES);
  }
}

// A grid of voxels as given, straight into bricks_append.
struct Cut {
  PlannedScene scene;
  Medium medium{};
  Cut(const Grid& grid, int interpolation) {
    medium.interpolation = interpolation;
    medium.liquid = -1;
    bricks_append(grid, medium, scene);
  }
  int number(ivec3 b) const { return brick_number(scene, medium, b); }
};

Grid filled(ivec3 size, Border border, const std::function<float(ivec3)>& value) {
  Grid grid(size);
  grid.border = border;
  for_each(size, [&](ivec3 i) { grid.set(i, value(i)); });
  return grid;
}

TEST(Bricks, ConstantOnesShareOne) {
  // Along x: four bricks of 2, three of 5, one of both, three of 2 once more.
  const auto value = [](ivec3 i) { return i.x < 32 ? 2.0f : i.x < 60 ? 5.0f : 2.0f; };
  const Grid grid = filled({88, 8, 8}, Border::CLAMP, value);
  const Cut cut(grid, INTERPOLATION_NEAREST);
  expect_bricks_of(grid, cut.scene, cut.medium);
  EXPECT_EQ(cut.scene.bricks.size(), 2u + 2 * BRICK_BLOCK_ENTRIES);
  EXPECT_EQ(cut.scene.voxels.size(), 3u * BRICK_VALUES);
  EXPECT_EQ(cut.number({0, 0, 0}), cut.number({10, 0, 0}));
  EXPECT_EQ(cut.number({4, 0, 0}), cut.number({6, 0, 0}));
  EXPECT_NE(cut.number({0, 0, 0}), cut.number({4, 0, 0}));
  EXPECT_NE(cut.number({7, 0, 0}), cut.number({0, 0, 0}));
}

// With trilinear the brick beside another value reads it, and is no constant one.
TEST(Bricks, ABrickBesideAnotherValueIsNotConstant) {
  const Grid grid = filled({48, 8, 8}, Border::CLAMP, [](ivec3 i) { return i.x < 24 ? 2.0f : 5.0f; });
  const Cut cut(grid, INTERPOLATION_TRILINEAR);
  expect_bricks_of(grid, cut.scene, cut.medium);
  const std::map<int, int> uses = entries_of(cut.scene, cut.medium);
  EXPECT_EQ(cut.scene.voxels.size(), uses.size() * BRICK_VALUES);
  EXPECT_EQ(cut.number({0, 0, 0}), cut.number({1, 0, 0}));
  EXPECT_NE(cut.number({3, 0, 0}),
            cut.number({4, 0, 0}));  // cells 24 ... 31 lie between samples 23 and 31: from 2 to 5
}

TEST(Bricks, BordersByTheirRule) {
  for (const Border border : {Border::CLAMP, Border::ZERO}) {
    const Grid grid =
        filled({8, 8, 8}, border, [](ivec3 i) { return static_cast<float>(1 + i.x + 8 * i.y + 64 * i.z); });
    const Cut cut(grid, INTERPOLATION_TRILINEAR);
    expect_bricks_of(grid, cut.scene, cut.medium);
    const bool zero = border == Border::ZERO;
    EXPECT_EQ(stored_sample(cut.scene, cut.medium, {0, 0, 0}, {0, 1, 1}), zero ? 0 : 1);
    EXPECT_EQ(stored_sample(cut.scene, cut.medium, {0, 0, 0}, {1, 1, 1}), 1);
    EXPECT_EQ(stored_sample(cut.scene, cut.medium, {1, 1, 1}, {0, 0, 0}), 512);
    EXPECT_EQ(stored_sample(cut.scene, cut.medium, {1, 1, 1}, {1, 0, 0}), zero ? 0 : 512);
    EXPECT_EQ(stored_sample(cut.scene, cut.medium, {1, 1, 1}, {1, 1, 1}), zero ? 0 : 512);
    EXPECT_EQ(cut.medium.lo.x, zero ? 0.0f : 0.5f);
    EXPECT_EQ(cut.medium.hi.x, zero ? 9.0f : 8.5f);
  }
}

// A lookup on the face between two bricks reads the same from either, also where one of them is empty.
TEST(Bricks, NeighboursAgreeOnTheFacesTheyShare) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> uniform(0, 1);
  const auto sparse = [&](ivec3) { return uniform(random) < 0.002f ? uniform(random) : 0.0f; };
  for (const Border border : {Border::CLAMP, Border::ZERO}) {
    const Grid grid = filled({40, 25, 33}, border, sparse);
    const Cut cut(grid, INTERPOLATION_TRILINEAR);
    expect_bricks_of(grid, cut.scene, cut.medium);
    const ivec3 bricks(cut.medium.brick_nx, cut.medium.brick_ny, cut.medium.brick_nz);
    int empty = 0;
    for_each(bricks, [&](ivec3 b) {
      empty += cut.number(b) == BRICK_EMPTY;
      for (int axis = 0; axis < 3; ++axis) {
        ivec3 next = b, face(BRICK_SAMPLES);
        face[axis] = 1;
        if (++next[axis] == bricks[axis]) continue;
        for_each(face, [&](ivec3 i) {
          ivec3 last = i;
          last[axis] = BRICK_SAMPLES - 1;
          EXPECT_EQ(stored_sample(cut.scene, cut.medium, b, last), stored_sample(cut.scene, cut.medium, next, i));
        });
      }
    });
    EXPECT_GT(empty, 0);
    EXPECT_LT(empty, bricks.x * bricks.y * bricks.z);
  }
}

// What is filled as one is cut as one, and every brick is what its samples say.
TEST(Bricks, FilledBlocks) {
  for (const int interpolation : {INTERPOLATION_NEAREST, INTERPOLATION_TRILINEAR})
    for (const Border border : {Border::CLAMP, Border::ZERO}) {
      Grid grid({60, 44, 37});
      grid.border = border;
      grid.fill({3, 0, 5}, {59, 40, 36}, 2.0f);
      grid.fill({16, 16, 16}, {31, 31, 23}, 5.0f);
      grid.set({40, 20, 20}, 7.0f);  // its block is no longer shared
      grid.set({48, 20, 20}, 2.0f);
      EXPECT_EQ(grid.at({41, 20, 20}), 2.0f);
      EXPECT_TRUE(grid.block_uniform({6, 2, 2}));
      EXPECT_FALSE(grid.block_uniform({5, 2, 2}));
      const Cut cut(grid, interpolation);
      expect_bricks_of(grid, cut.scene, cut.medium);
    }
}

// Blocks of the index: of nothing, of one value, and of all kinds; two such of a kind share their entries.
TEST(Bricks, BlocksOfTheIndexShareWhatIsTheSame) {
  for (const int interpolation : {INTERPOLATION_NEAREST, INTERPOLATION_TRILINEAR})
    for (const Border border : {Border::CLAMP, Border::ZERO}) {
      Grid grid({330, 70, 66});
      grid.border = border;
      grid.fill({0, 0, 0}, {199, 69, 65}, 2.0f);
      grid.set({329, 69, 65}, 3.0f);
      const Cut cut(grid, interpolation);
      expect_bricks_of(grid, cut.scene, cut.medium);
      const std::set<int> begins(cut.scene.bricks.begin(), cut.scene.bricks.begin() + 6 * 2 * 2);
      EXPECT_LT(begins.size(), 24u);
      EXPECT_EQ(cut.scene.bricks.size(), 24u + begins.size() * BRICK_BLOCK_ENTRIES);
      EXPECT_LT(cut.scene.voxels.size(), 60u * BRICK_VALUES);  // the sides, edges and corners of the box once each
    }
}

// What is stored costs, and not the way between.
TEST(Bricks, TwoVoxelsFarApart) {
  for (const int interpolation : {INTERPOLATION_NEAREST, INTERPOLATION_TRILINEAR}) {
    Grid grid(ivec3(5001));
    grid.border = Border::ZERO;
    grid.set({0, 0, 0}, 1.0f);
    grid.set({5000, 5000, 5000}, 2.0f);
    const Cut cut(grid, interpolation);
    EXPECT_LT(cut.scene.bricks.size() * sizeof(int), 3u << 20);
    EXPECT_LE(cut.scene.voxels.size(), 16u * BRICK_VALUES);
    const int pad = interpolation == INTERPOLATION_TRILINEAR ? 1 : 0;
    EXPECT_EQ(stored_sample(cut.scene, cut.medium, ivec3(0), ivec3(pad)), 1);
    EXPECT_EQ(stored_sample(cut.scene, cut.medium, ivec3(625), ivec3(pad)), 2);
    EXPECT_EQ(cut.medium.hi.x, 5001.0f + static_cast<float>(pad));
  }
}

// The form that gives the grid's memory back cuts the same bricks.
TEST(Bricks, CutWhileTheGridIsGivenBack) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(0.1f, 1);
  for (const int interpolation : {INTERPOLATION_NEAREST, INTERPOLATION_TRILINEAR}) {
    Grid grid = filled({20, 70, 200}, Border::ZERO, [&](ivec3) { return uniform(random); });
    const Cut kept(grid, interpolation);
    Cut given(Grid(ivec3(1)), interpolation);
    given.scene = PlannedScene{};
    bricks_append(std::move(grid), given.medium, given.scene);
    EXPECT_EQ(given.scene.bricks, kept.scene.bricks);
    EXPECT_EQ(given.scene.voxels, kept.scene.voxels);
    EXPECT_EQ(given.scene.brick_ranges, kept.scene.brick_ranges);
    // what it has given back
    EXPECT_LT(grid.stored_bytes(), 100u << 10);  // NOLINT(bugprone-use-after-move)
    EXPECT_EQ(grid.at({19, 69, 199}), 0);
  }
}

TEST(Bricks, AGridOfZerosHasNone) {
  const Cut cut(Grid({20, 8, 8}), INTERPOLATION_TRILINEAR);
  EXPECT_TRUE(cut.scene.voxels.empty());
  EXPECT_TRUE(cut.scene.brick_ranges.empty());
  EXPECT_EQ(entries_of(cut.scene, cut.medium), (std::map<int, int>{{BRICK_EMPTY, 3 * 2 * 2}}));
}

// The second medium's entries begin behind the first one's; numbers of stored bricks go on.
TEST(Bricks, MediaFollowEachOther) {
  SceneDesc desc = scene_with(generator("perlin", {9, 10, 11}), INTERPOLATION_TRILINEAR);
  desc.media.push_back(desc.media[0]);
  desc.media[1].density = generator("linear", {20, 5, 8});
  desc.media[1].interpolation = INTERPOLATION_NEAREST;
  const PlannedScene scene = flatten(desc, {});
  ASSERT_EQ(scene.media.size(), 2u);
  EXPECT_EQ(scene.grids[0].brick_offset, 0);
  EXPECT_EQ(scene.grids[1].brick_offset, 1 + BRICK_BLOCK_ENTRIES);
  EXPECT_EQ(scene.bricks.size(), 2u * (1 + BRICK_BLOCK_ENTRIES));
  for (int i : {0, 1}) expect_bricks_of(grid_of(desc.media[i].density), scene, scene.medium(i));
}

TEST_F(Vdb, BricksFadeToZeroAroundTheFile) {
  const auto g = grid();
  std::mt19937 random(9);
  std::uniform_real_distribution<float> uniform(0.1f, 1);
  for (int z = -7; z < 12; ++z)
    for (int y = 3; y < 20; ++y)
      for (int x = -3; x < 14; ++x) g->tree().setValueOn(openvdb::Coord(x, y, z), uniform(random));
  g->setTransform(openvdb::math::Transform::createLinearTransform(0.25));
  DensityDesc density;
  density.type = "file";
  density.file = file({g});
  for (const int interpolation : {INTERPOLATION_NEAREST, INTERPOLATION_TRILINEAR}) {
    const PlannedScene scene = flatten(scene_with(density, interpolation), {});
    const Grid read = volume_read(density.file);
    ASSERT_EQ(read.border, Border::ZERO);
    expect_bricks_of(read, scene, scene.medium(0));
    // Index (-3, 3, -7) is the first sample: cell-space 1 of trilinear, the middle of cell 0 of nearest.
    const dvec3 at(interpolation == INTERPOLATION_TRILINEAR ? 1.0 : 0.5);
    EXPECT_LT(glm::distance(world_of(scene, scene.medium(0), at), 0.25 * dvec3(-3, 3, -7)), 1e-5);
  }
}

// Generators fill their bounds: the outermost samples lie half a voxel inside.
TEST(Bricks, GeneratorsFillTheirBounds) {
  for (const int interpolation : {INTERPOLATION_NEAREST, INTERPOLATION_TRILINEAR}) {
    SceneDesc desc = scene_with(generator("exponential", {4, 8, 2}), interpolation);
    desc.media[0].bounds = {dvec3(0, 0, 0), dvec3(4, 16, 1)};
    const PlannedScene scene = flatten(desc, {});
    const Medium m = scene.medium(0);
    EXPECT_LT(glm::distance(world_of(scene, m, {m.lo.x, m.lo.y, m.lo.z}), dvec3(0)), 1e-5);
    EXPECT_LT(glm::distance(world_of(scene, m, {m.hi.x, m.hi.y, m.hi.z}), dvec3(4, 16, 1)), 1e-5);
    const dvec3 at(interpolation == INTERPOLATION_TRILINEAR ? 1.0 : 0.5);
    EXPECT_LT(glm::distance(world_of(scene, m, at), dvec3(0.5, 1, 0.25)), 1e-5);
  }
}

}  // namespace
}  // namespace brume
