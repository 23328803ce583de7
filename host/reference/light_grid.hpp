// Light grids in double precision: no point is skipped.
#pragma once
#include "reference/scatter.hpp"

namespace brume::reference {

LightDepths light_grids_make(const Context& context, const Medium& medium);

const LightGrid& light_grid_of(const PlannedScene& scene, const Medium& medium, std::size_t light);

// τ per channel from a world point inside the medium to a light, blended from the eight points about it.
dvec3 light_grid_tau(const LightDepths& depths, const LightGrid& grid, const Medium& medium, std::size_t light,
                     const dvec3& point);

}  // namespace brume::reference
