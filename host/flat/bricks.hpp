// The bricks of grids in a flat scene (layout: shared/medium.h): how they are made, and how one is found.
#pragma once
#include <glm/ext/vector_int3_sized.hpp>

#include "flat/flat_scene.hpp"
#include "volume/grid.hpp"

namespace brume {

// Appends the bricks of a grid: index, ranges and samples; fills in the medium's geometry. Throws InputError where the
// scene would hold more of them than 32-bit offsets can count. A medium whose `liquid` is not -1 shares bricks of one
// value only: others have gradients of their own. The second form gives the grid's memory back as it goes:
// afterwards it reads as 0.
void bricks_append(const Grid& grid, Medium& medium, FlatScene& scene);
void bricks_append(Grid&& grid, Medium& medium, FlatScene& scene);

// The bricks of a grid of presences, the last that were appended, from that of first_voxel on: adds them to those whose
// gradients are stored, as part of the medium that comes next. Returns Liquid::gradients.
int gradient_bricks_append(const Medium& medium, std::size_t first_voxel, FlatScene& scene);

// What bricks_append says of the grid itself, without where it stands.
BrickGrid brick_grid_of(const Medium& medium);

// Where the entries of a block of bricks begin; blocks that are alike share them. 0 <= block < blocks.
std::int32_t brick_block_entries(const FlatScene& scene, const Medium& medium, glm::ivec3 block);

// Number of the samples of brick b of the medium's grid, or BRICK_EMPTY. 0 <= b < brick_n.
std::int32_t brick_entry(const FlatScene& scene, const Medium& medium, glm::ivec3 b);

}  // namespace brume
