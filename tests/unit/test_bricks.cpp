// Grids as bricks (layout: shared/medium.h), through flatten() and so with generators and OpenVDB files as they come: every
// sample, entry and range against the grid itself.
#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <map>
#include <random>

#include "flat/flatten.hpp"
#include "flat/flatten_parts.hpp"
#include "vdb_fixture.hpp"
#include "volume/density_source.hpp"

namespace brume {
namespace {

using test::Vdb;

SceneDesc scene_with(const DensityDesc& density, int interpolation) {
  SceneDesc scene;
  MediumDesc medium;
  medium.density = density;
  medium.interpolation = interpolation;
  medium.sigma_a = dvec3(1);
  scene.media.push_back(medium);
  return scene;
}

// What a lookup of cell-space sample s must give, from the definition: nearest: voxel s; trilinear: sample s - 1 of the grid, its
// border repeated (CLAMP) or 0 around it (ZERO).
double sample_of(const Grid& grid, ivec3 s, bool trilinear) {
  if (trilinear) s -= 1;
  const bool outside = s != glm::clamp(s, ivec3(0), grid.size() - 1);
  if (outside && grid.border == Border::ZERO) return 0;
  return grid.at(glm::clamp(s, ivec3(0), grid.size() - 1));
}

std::size_t brick_index(const Medium& m, ivec3 b) {
  return static_cast<std::size_t>(m.brick_offset) +
         (static_cast<std::size_t>(b.z) * static_cast<std::size_t>(m.brick_ny) + static_cast<std::size_t>(b.y)) *
             static_cast<std::size_t>(m.brick_nx) +
         static_cast<std::size_t>(b.x);
}

// Sample i, 0 ... 8 on each axis, of brick b.
double stored_sample(const FlatScene& scene, const Medium& m, ivec3 b, ivec3 i) {
  const int number = scene.bricks.at(brick_index(m, b));
  if (number == BRICK_EMPTY) return 0;
  return scene.voxels.at(static_cast<std::size_t>(number) * BRICK_VALUES +
                         static_cast<std::size_t>(i.x + BRICK_SAMPLES * (i.y + BRICK_SAMPLES * i.z)));
}

template <class Visit>
void for_each(ivec3 size, Visit visit) {
  for (ivec3 i(0); i.z < size.z; ++i.z)
    for (i.y = 0; i.y < size.y; ++i.y)
      for (i.x = 0; i.x < size.x; ++i.x) visit(i);
}

// Everything that the layout promises of the bricks of one grid.
void expect_bricks_of(const Grid& grid, const FlatScene& scene, const Medium& m) {
  const bool trilinear = m.interpolation == INTERPOLATION_TRILINEAR;
  const ivec3 cells(m.cells_x, m.cells_y, m.cells_z), bricks(m.brick_nx, m.brick_ny, m.brick_nz);
  ASSERT_EQ(cells, grid.size() + (trilinear ? 1 : 0));
  for (int axis = 0; axis < 3; ++axis) ASSERT_EQ(bricks[axis], std::ceil(cells[axis] / 8.0));
  const ivec3 reads(trilinear ? 2 : 1);  // samples that one cell reads, on each axis
  dvec3 lo(1e9), hi(-1e9);               // around the cells that are not 0
  for_each(bricks, [&](ivec3 b) {
    double min = 1e9, max = -1e9;
    for_each(glm::min(cells - 8 * b, ivec3(8)), [&](ivec3 c) {
      double cell_max = 0;
      for_each(reads, [&](ivec3 k) {
        const double expected = sample_of(grid, 8 * b + c + k, trilinear);
        ASSERT_EQ(stored_sample(scene, m, b, c + k), expected)
            << "brick " << b.x << " " << b.y << " " << b.z << " cell " << c.x << " " << c.y << " " << c.z;
        min = std::min(min, expected);
        max = std::max(max, expected);
        cell_max = std::max(cell_max, expected);
      });
      if (cell_max == 0) return;
      lo = glm::min(lo, dvec3(8 * b + c));
      hi = glm::max(hi, dvec3(8 * b + c + 1));
    });
    const std::size_t index = brick_index(m, b);
    EXPECT_EQ(scene.bricks.at(index) == BRICK_EMPTY, max == 0);
    EXPECT_EQ(scene.brick_ranges.at(2 * index), min) << b.x << " " << b.y << " " << b.z;
    EXPECT_EQ(scene.brick_ranges.at(2 * index + 1), max) << b.x << " " << b.y << " " << b.z;
  });
  if (hi.x < 0) return;
  // The region: the cells that are not 0, within the grid's own bounds. A CLAMP grid ends half a cell inside its outermost cells.
  const double margin = trilinear && grid.border == Border::CLAMP ? 0.5 : 0;
  lo = glm::max(lo, dvec3(margin));
  hi = glm::min(hi, dvec3(cells) - margin);
  EXPECT_EQ(dvec3(m.lo.x, m.lo.y, m.lo.z), lo);
  EXPECT_EQ(dvec3(m.hi.x, m.hi.y, m.hi.z), hi);
}

// Where cell-space position s is in the world: sample s of the padded lattice sits where the grid says that sample s - 1 sits.
dvec3 world_of(const FlatScene& scene, const Medium& m, const dvec3& p) {
  dvec3 w(0);
  for (int row = 0; row < 3; ++row)
    w[row] = m.world_from_cell.m[4 * row] * p.x + m.world_from_cell.m[4 * row + 1] * p.y +
             m.world_from_cell.m[4 * row + 2] * p.z + m.world_from_cell.m[4 * row + 3];
  return scene.world(w);
}

DensityDesc generator(const std::string& type, ivec3 resolution) {
  DensityDesc d;
  d.type = type;
  d.resolution = resolution;
  d.scale = 3;
  return d;
}

DensitySpec spec_of(const DensityDesc& d) {
  DensitySpec spec;
  spec.type = d.type;
  spec.resolution = d.resolution;
  spec.scale = d.scale;
  if (d.of) spec.of = std::make_shared<DensitySpec>(spec_of(*d.of));
  return spec;
}
Grid grid_of(const DensityDesc& d) { return density_make(spec_of(d)); }

TEST(Bricks, OfGenerators) {
  for (const int interpolation : {INTERPOLATION_NEAREST, INTERPOLATION_TRILINEAR})
    for (const ivec3 size : {ivec3(1), ivec3(7, 8, 9), ivec3(16, 15, 17), ivec3(3, 30, 24)})
      for (const char* type : {"linear", "perlin", "exponential"}) {
        SCOPED_TRACE(std::string(type) + " " + std::to_string(size.x) + " " + std::to_string(interpolation));
        const DensityDesc density = generator(type, size);
        const FlatScene scene = flatten(scene_with(density, interpolation), {});
        ASSERT_EQ(scene.media.size(), 1u);
        expect_bricks_of(grid_of(density), scene, scene.media[0]);
      }
}

// A ball in a cube: its corners are empty bricks.
TEST(Bricks, EmptyOnesAreNotStored) {
  DensityDesc ball = generator("sphere", ivec3(64));
  ball.of = std::make_shared<DensityDesc>(generator("perlin", ivec3(64)));
  for (const int interpolation : {INTERPOLATION_NEAREST, INTERPOLATION_TRILINEAR}) {
    const FlatScene scene = flatten(scene_with(ball, interpolation), {});
    const Grid grid = grid_of(ball);
    expect_bricks_of(grid, scene, scene.media.at(0));
    const auto empty = std::count(scene.bricks.begin(), scene.bricks.end(), BRICK_EMPTY);
    EXPECT_GE(empty, 8);
    EXPECT_EQ(scene.voxels.size(), (scene.bricks.size() - static_cast<std::size_t>(empty)) * BRICK_VALUES);
  }
}

// A grid of voxels as given, straight into bricks_append.
struct Cut {
  FlatScene scene;
  Medium medium{};
  Cut(const Grid& grid, int interpolation) {
    medium.interpolation = interpolation;
    bricks_append(grid, medium, scene);
  }
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
  EXPECT_EQ(cut.scene.bricks.size(), 11u);
  EXPECT_EQ(cut.scene.voxels.size(), 3u * BRICK_VALUES);
  EXPECT_EQ(cut.scene.bricks[0], cut.scene.bricks[10]);
  EXPECT_EQ(cut.scene.bricks[4], cut.scene.bricks[6]);
  EXPECT_NE(cut.scene.bricks[0], cut.scene.bricks[4]);
  EXPECT_NE(cut.scene.bricks[7], cut.scene.bricks[0]);
}

// With trilinear the brick beside another value reads it, and is no constant one.
TEST(Bricks, ABrickBesideAnotherValueIsNotConstant) {
  const Grid grid = filled({48, 8, 8}, Border::CLAMP, [](ivec3 i) { return i.x < 24 ? 2.0f : 5.0f; });
  const Cut cut(grid, INTERPOLATION_TRILINEAR);
  expect_bricks_of(grid, cut.scene, cut.medium);
  std::map<int, int> uses;
  for (const int number : cut.scene.bricks) ++uses[number];
  EXPECT_EQ(cut.scene.voxels.size(), uses.size() * BRICK_VALUES);
  EXPECT_EQ(cut.scene.bricks[0], cut.scene.bricks[1]);
  EXPECT_NE(cut.scene.bricks[3], cut.scene.bricks[4]);  // cells 24 ... 31 lie between samples 23 and 31: from 2 to 5
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
      empty += cut.scene.bricks[brick_index(cut.medium, b)] == BRICK_EMPTY;
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

TEST(Bricks, AGridOfZerosHasNone) {
  const Cut cut(Grid({20, 8, 8}), INTERPOLATION_TRILINEAR);
  EXPECT_TRUE(cut.scene.voxels.empty());
  EXPECT_EQ(cut.scene.bricks, std::vector<std::int32_t>(3 * 2 * 2, BRICK_EMPTY));
  EXPECT_EQ(cut.scene.brick_ranges, std::vector<float>(2 * 3 * 2 * 2, 0.0f));
}

// The second medium's entries begin behind the first one's; numbers of stored bricks go on.
TEST(Bricks, MediaFollowEachOther) {
  SceneDesc desc = scene_with(generator("perlin", {9, 10, 11}), INTERPOLATION_TRILINEAR);
  desc.media.push_back(desc.media[0]);
  desc.media[1].density = generator("linear", {20, 5, 8});
  desc.media[1].interpolation = INTERPOLATION_NEAREST;
  const FlatScene scene = flatten(desc, {});
  ASSERT_EQ(scene.media.size(), 2u);
  EXPECT_EQ(scene.media[0].brick_offset, 0);
  EXPECT_EQ(scene.media[1].brick_offset, 2 * 2 * 2);
  EXPECT_EQ(scene.bricks.size(), 8u + 3);
  for (int i : {0, 1}) expect_bricks_of(grid_of(desc.media[i].density), scene, scene.media[i]);
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
    const FlatScene scene = flatten(scene_with(density, interpolation), {});
    const Grid read = volume_read(density.file);
    ASSERT_EQ(read.border, Border::ZERO);
    expect_bricks_of(read, scene, scene.media.at(0));
    // Index (-3, 3, -7) is the first sample: cell-space 1 of trilinear, the middle of cell 0 of nearest.
    const dvec3 at(interpolation == INTERPOLATION_TRILINEAR ? 1.0 : 0.5);
    EXPECT_LT(glm::distance(world_of(scene, scene.media[0], at), 0.25 * dvec3(-3, 3, -7)), 1e-5);
  }
}

// Generators fill their bounds: the outermost samples lie half a voxel inside.
TEST(Bricks, GeneratorsFillTheirBounds) {
  for (const int interpolation : {INTERPOLATION_NEAREST, INTERPOLATION_TRILINEAR}) {
    SceneDesc desc = scene_with(generator("exponential", {4, 8, 2}), interpolation);
    desc.media[0].bounds = {dvec3(0, 0, 0), dvec3(4, 16, 1)};
    const FlatScene scene = flatten(desc, {});
    const Medium& m = scene.media.at(0);
    EXPECT_LT(glm::distance(world_of(scene, m, {m.lo.x, m.lo.y, m.lo.z}), dvec3(0)), 1e-5);
    EXPECT_LT(glm::distance(world_of(scene, m, {m.hi.x, m.hi.y, m.hi.z}), dvec3(4, 16, 1)), 1e-5);
    const dvec3 at(interpolation == INTERPOLATION_TRILINEAR ? 1.0 : 0.5);
    EXPECT_LT(glm::distance(world_of(scene, m, at), dvec3(0.5, 1, 0.25)), 1e-5);
  }
}

}  // namespace
}  // namespace brume
