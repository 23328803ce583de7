// Segments of a constant medium for the rule `gauss2` (PICTURE, Lit steps).
#pragma once
#include <vector>

#include "reference/scatter.hpp"

namespace brume::reference {

// Where along a ray the cones of a spot lie: its soft edge in eight equal parts of 1 - cos. In no order.
std::vector<double> spot_cones(const Light& light, const RayD& ray);

// Of medium `index` along a view ray up to t_max, in order and without gaps.
std::vector<SegmentD> lit_segments(const Context& context, int index, const RayD& ray, double t_max);

}  // namespace brume::reference
