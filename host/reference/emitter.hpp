// Surfaces that emit, as lights (PICTURE, Lights with an area).
#pragma once
#include "reference/light.hpp"

namespace brume::reference {

// Which place of the surface light.primitive a point asks, and what comes from there.
LightSample emitter_at(const PlannedScene& scene, const Light& light, const dvec3& point, const RandomStream& random);

}  // namespace brume::reference
