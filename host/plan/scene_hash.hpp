// One number for everything in a flat scene and its plan that decides its picture.
#pragma once
#include <cstdint>

#include "plan/render_plan.hpp"

namespace brume {

// Equal for equal pictures of whatever crop, on any device. Left out: the crop, film size, samples per pixel and seed,
// which are compared by themselves; the BVH, which follows from the triangles and the lanes; what only names or tells.
std::uint64_t scene_hash(const PlannedScene& scene);

}  // namespace brume
