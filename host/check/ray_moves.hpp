// Where a comparison is worth nothing: values that the reference itself changes when its ray moves by some digits of
// float.
#pragma once
#include <functional>
#include <vector>

#include "check/check.hpp"
#include "reference/vec.hpp"

namespace brume {

inline constexpr int RAY_MOVES = 12;

// The ray with its origin or direction moved along one axis, to one side, by four digits of float: about half of what
// the tolerance `camera` allows. 0 <= move < RAY_MOVES.
reference::RayD ray_moved(const reference::RayD& ray, int move);

// Adds the values of a ray or pixel. Where they disagree, and the reference with a moved ray disagrees with itself as
// well (a ray along a plane or past a silhouette, a sample on a voxel's face, another number of steps or collisions),
// it is an edge; never where a value is no number.
void add_or_edge(ErrorSum& sum, const std::vector<double>& kernel, const std::vector<double>& reference,
                 const std::function<std::vector<double>(int move)>& moved);

}  // namespace brume
