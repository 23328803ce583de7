// Liquids by local lighting (PICTURE, Liquids).
#pragma once
#include "reference/scatter.hpp"

namespace brume::reference {

// A step through a liquid: its presence where it begins and ends, between which it is linear.
struct PresenceStep {
  double t_begin, t_end, before, after;
  uint id;  // number of the border at its end
};

// The medium with steps so short that they are no longer seen.
Medium presence_fine(Medium medium);

std::vector<PresenceStep> presence_steps(const PlannedScene& scene, const Medium& medium, const RayD& ray,
                                         const Interval& span);

// The same as segments with ∫ρ, where a presence below `outside` counts as 0.
std::vector<SegmentD> presence_segments(const PlannedScene& scene, const Medium& medium, const RayD& ray,
                                        const Interval& span);

// Half the differences of the presence along the axes of cell space, at a point of it, as stored.
dvec3 presence_gradient(const PlannedScene& scene, const Medium& medium, const dvec3& cell_position);

// What liquid `index` sends to the origin: adds to result.radiance and result.tau.
void liquid_scatter(const Context& context, int index, const RayD& ray, double t_max, const RandomStream& random,
                    Scattered& result);

}  // namespace brume::reference
