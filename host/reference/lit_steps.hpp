// Segments of a constant medium for the rule `gauss2` (PICTURE, Lit steps).
#pragma once
#include <vector>

#include "reference/scatter.hpp"

namespace brume::reference {

// Of medium `index` along a view ray up to t_max, in order and without gaps.
std::vector<SegmentD> lit_segments(const Context& context, int index, const RayD& ray, double t_max);

}  // namespace brume::reference
