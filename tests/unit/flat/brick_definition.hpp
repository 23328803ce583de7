// What a grid cut into bricks must hold (layout: shared/medium.h), from the definition.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "flat/bricks.hpp"
#include "flat/flatten_parts.hpp"
#include "plan/planned_scene.hpp"
#include "volume/density_source.hpp"
#include "volume/grid.hpp"

namespace brume::test {

using glm::ivec3;

inline SceneDesc scene_with(const DensityDesc& density, int interpolation) {
  SceneDesc scene;
  MediumDesc medium;
  medium.density = density;
  medium.interpolation = interpolation;
  medium.sigma_a = dvec3(1);
  scene.media.push_back(medium);
  return scene;
}

// What a lookup of cell-space sample s must give, from the definition: nearest: voxel s; trilinear: sample s - 1 of the
// grid, its border repeated (CLAMP) or 0 around it (ZERO).
inline double sample_of(const Grid& grid, ivec3 s, bool trilinear) {
  if (trilinear) s -= 1;
  const bool outside = s != glm::clamp(s, ivec3(0), grid.size() - 1);
  if (outside && grid.border == Border::ZERO) return 0;
  return grid.at(glm::clamp(s, ivec3(0), grid.size() - 1));
}

// Number of the samples of brick b, from the definition of the index.
inline int brick_number(const FlatScene& scene, const Medium& m, ivec3 b) {
  const ivec3 block = b / 8, in = b % 8, blocks((m.brick_nx + 7) / 8, (m.brick_ny + 7) / 8, 0);
  const auto begin = static_cast<std::size_t>(
      scene.bricks.at(static_cast<std::size_t>(m.brick_offset) +
                      static_cast<std::size_t>(block.z * blocks.y + block.y) * static_cast<std::size_t>(blocks.x) +
                      static_cast<std::size_t>(block.x)));
  return scene.bricks.at(begin + static_cast<std::size_t>(in.z * 8 + in.y) * 8 + static_cast<std::size_t>(in.x));
}

// Sample i, 0 ... 8 on each axis, of brick b.
inline double stored_sample(const FlatScene& scene, const Medium& m, ivec3 b, ivec3 i) {
  const int number = brick_number(scene, m, b);
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
inline void expect_bricks_of(const Grid& grid, const PlannedScene& scene, const Medium& m) {
  const bool trilinear = m.interpolation == INTERPOLATION_TRILINEAR;
  const ivec3 cells(m.cells_x, m.cells_y, m.cells_z), bricks(m.brick_nx, m.brick_ny, m.brick_nz);
  ASSERT_EQ(cells, grid.size() + (trilinear ? 1 : 0));
  for (int axis = 0; axis < 3; ++axis) ASSERT_EQ(bricks[axis], std::ceil(cells[axis] / 8.0));
  EXPECT_EQ(scene.brick_ranges.size() * BRICK_VALUES, 2 * scene.voxels.size());
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
    const int number = brick_number(scene, m, b);
    EXPECT_EQ(brick_entry(scene, m, b), number);
    EXPECT_EQ(number == BRICK_EMPTY, max == 0);
    if (number == BRICK_EMPTY) return;
    EXPECT_EQ(scene.brick_ranges.at(2 * static_cast<std::size_t>(number)), min) << b.x << " " << b.y << " " << b.z;
    EXPECT_EQ(scene.brick_ranges.at(2 * static_cast<std::size_t>(number) + 1), max) << b.x << " " << b.y << " " << b.z;
  });
  if (hi.x < 0) return;
  // The region: the cells that are not 0, within the grid's own bounds. A CLAMP grid ends half a cell inside its
  // outermost cells.
  const double margin = trilinear && grid.border == Border::CLAMP ? 0.5 : 0;
  lo = glm::max(lo, dvec3(margin));
  hi = glm::min(hi, dvec3(cells) - margin);
  EXPECT_EQ(dvec3(m.lo.x, m.lo.y, m.lo.z), lo);
  EXPECT_EQ(dvec3(m.hi.x, m.hi.y, m.hi.z), hi);
}

// Where cell-space position s is in the world: sample s of the padded lattice sits where the grid says that sample s -
// 1 sits.
inline dvec3 world_of(const PlannedScene& scene, const Medium& m, const dvec3& p) {
  dvec3 w(0);
  for (int row = 0; row < 3; ++row)
    w[row] = m.world_from_cell.m[4 * row] * p.x + m.world_from_cell.m[4 * row + 1] * p.y +
             m.world_from_cell.m[4 * row + 2] * p.z + m.world_from_cell.m[4 * row + 3];
  return scene.world(w);
}

inline DensityDesc generator(const std::string& type, ivec3 resolution) {
  DensityDesc d;
  d.type = type;
  d.resolution = resolution;
  d.scale = 3;
  return d;
}

inline DensitySpec spec_of(const DensityDesc& d) {
  DensitySpec spec;
  spec.type = d.type;
  spec.resolution = d.resolution;
  spec.scale = d.scale;
  if (d.of) spec.of = std::make_shared<DensitySpec>(spec_of(*d.of));
  return spec;
}
inline Grid grid_of(const DensityDesc& d) { return density_make(spec_of(d)); }

}  // namespace brume::test
