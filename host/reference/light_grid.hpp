// Light grids in double precision: every point is traced, none is skipped.
#pragma once
#include "reference/scatter.hpp"

namespace brume::reference {

LightGrid light_grid_make(const Context& context, const Medium& medium);

// τ per channel from a world point inside the medium to a light, blended from the eight points about it.
dvec3 light_grid_tau(const LightGrid& grid, const Medium& medium, std::size_t light, const dvec3& point);

}  // namespace brume::reference
