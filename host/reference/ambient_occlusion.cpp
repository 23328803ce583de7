// See ambient_occlusion.hpp.
#include "reference/ambient_occlusion.hpp"

#include <cmath>

namespace brume::reference {

Sky ambient_occlusion(const Context& context, const SurfaceD& surface, const RandomStream& random) {
  const Frame& frame = context.scene.frame;
  const uint golden = 2654435769u, width = static_cast<uint>(frame.camera.width);  // 2^32 over the golden ratio
  const uint x = random.pixel % width, y = random.pixel / width;
  const uint turn = frame.occlusion_rotates ? x * 3242174889u + y * 2447445414u + random.sample * golden : 0u;
  const auto side = vec_beside(surface.normal);
  Sky sky;
  for (int i = 0; i < frame.directions; ++i) {
    const double cosine = 1 - (2 * i + 1) / (2.0 * frame.directions), sine = std::sqrt(1 - cosine * cosine);
    const double angle = 2 * M_PI * ((turn + static_cast<uint>(i) * golden) >> 8) * 0x1p-24;
    const dvec3 dir = cosine * surface.normal + sine * (std::cos(angle) * side[0] + std::sin(angle) * side[1]);
    const bool sees =
        glm::dot(dir, surface.geometric_normal) > 0 &&
        !occluded(context.scene, context.bounds, {surface_leave(surface, dir), dir}, double(frame.occlusion_reach));
    if (sees) sky.open += 2 * cosine / frame.directions;
    sky.seen = sky.seen * 31u + sees;
  }
  return sky;
}

}  // namespace brume::reference
