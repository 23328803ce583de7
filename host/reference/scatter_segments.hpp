// What one medium scatters and emits towards the origin of a view ray, segment by segment (PICTURE, Media).
#pragma once
#include "reference/scatter.hpp"

namespace brume::reference {

// Medium `index` up to t_max, by segments or by collisions as its method wants: adds to result.radiance and result.tau.
// `random` is the ray's; medium m walks with its child m.
void medium_scatter(const Context& context, int index, const RayD& ray, double t_max, const RandomStream& random,
                    Scattered& result);

}  // namespace brume::reference
