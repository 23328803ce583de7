// The densest line of sight through a grid, as a camera sees it.
#pragma once
#include "volume/grid.hpp"

namespace brume {

// The stored blocks of a grid by z, then y, then x, and which of them lie in each group of blocks.
struct GridBlocks {
  struct Group {
    ivec3 index;
    std::vector<std::uint32_t> members;  // of `all`, ascending
  };
  std::vector<ivec3> all;
  std::vector<Group> groups;
};
GridBlocks grid_blocks(const Grid& grid);

// ∫ρ dt along a ray: trilinear, 0 beyond the samples as in Border::ZERO; world units. Exact up to rounding.
double grid_line_integral(const Grid& grid, const GridBlocks& blocks, const dvec3& from, const dvec3& dir);

// The largest ∫ρ dt of the rays from `eye` that pass through the grid; the eye is outside of it and looks at `target`.
double grid_densest_view(const Grid& grid, const dvec3& eye, const dvec3& target);

}  // namespace brume
