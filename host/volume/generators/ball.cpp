// The presence of a ball: over a ramp about its surface it falls evenly from 1 to 0, and is ½ on the surface itself.
#include <algorithm>
#include <glm/geometric.hpp>

#include "base/error.hpp"
#include "volume/generators/generators.hpp"

namespace brume {

Grid density_ball(const DensitySpec& spec) {
  if (!(spec.radius > 0 && spec.ramp > 0)) throw InputError("density 'ball': radius and ramp: expected numbers > 0");
  const dvec3 size(spec.resolution);
  const double voxels = 0.5 * std::min({size.x, size.y, size.z});  // half the shortest side
  return grid_generate(spec, [&](ivec3 i) {
    const double distance = voxels * (glm::length(2.0 * (dvec3(i) + 0.5) / size - 1.0) - spec.radius);
    return std::clamp(0.5 - distance / spec.ramp, 0.0, 1.0);
  });
}

}  // namespace brume
