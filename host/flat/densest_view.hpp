// The densest line of sight through a grid, as a camera sees it.
#pragma once
#include "volume/grid.hpp"

namespace brume {

// ∫ρ dt along a ray: trilinear, 0 beyond the samples as in Border::ZERO; world units. Exact up to rounding.
// `blocks`: those to look at, from grid_blocks().
double grid_line_integral(const Grid& grid, const std::vector<ivec3>& blocks, const dvec3& from, const dvec3& dir);
std::vector<ivec3> grid_blocks(const Grid& grid);  // those that are stored

// The largest ∫ρ dt of the rays from `eye` that pass through the grid; the eye is outside of it and looks at `target`.
double grid_densest_view(const Grid& grid, const dvec3& eye, const dvec3& target);

}  // namespace brume
