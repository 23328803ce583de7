// Segments of a constant medium for the rule `gauss2` (PICTURE, Lit steps).
#pragma once
#include <vector>

#include "reference/scatter.hpp"

namespace brume::reference {

// Where along a ray the cones of a spot lie: its soft edge in eight equal parts of 1 - cos. In no order.
std::vector<double> spot_cones(const Light& light, const RayD& ray);

// Where along a view ray within medium `index` the cones of spots lie and where the way to a light begins to leave the
// box of a medium by another face: the first 64, all cones before all boxes, in the order of lights, media, axes
// and edges.
struct LightKink {
  std::size_t light;
  double t;
};
std::vector<LightKink> light_kinks(const Context& context, int index, const RayD& ray, double t_max);

// Of medium `index` along a view ray up to t_max, in order and without gaps.
std::vector<SegmentD> lit_segments(const Context& context, int index, const RayD& ray, double t_max);

}  // namespace brume::reference
