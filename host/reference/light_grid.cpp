// See light_grid.hpp; the layout is the medium's own affair here, only the places of the points are shared/medium.h's.
#include "reference/light_grid.hpp"

#include <algorithm>
#include <cmath>

namespace brume::reference {
namespace {

ivec3 points_of(const Medium& m) { return {m.light_nx, m.light_ny, m.light_nz}; }

std::size_t index_of(const ivec3& n, std::size_t light, const ivec3& i) {
  return ((light * static_cast<std::size_t>(n.z) + static_cast<std::size_t>(i.z)) * static_cast<std::size_t>(n.y) +
          static_cast<std::size_t>(i.y)) *
             static_cast<std::size_t>(n.x) +
         static_cast<std::size_t>(i.x);
}

}  // namespace

LightGrid light_grid_make(const Context& context, const Medium& medium) {
  LightGrid grid;
  const ivec3 n = points_of(medium);
  const dvec3 lo = vec_promote(medium.lo), hi = vec_promote(medium.hi);
  for (std::size_t l = 0; l < context.scene.lights.size(); ++l)
    for (int z = 0; z < n.z; ++z)
      for (int y = 0; y < n.y; ++y)
        for (int x = 0; x < n.x; ++x) {
          const dvec3 cell = lo + (hi - lo) * (dvec3(x, y, z) / dvec3(n - 1));
          const dvec3 point = affine_point(medium.world_from_cell, cell);
          const LightSample sample = light_at(context.scene.lights[l], point);
          double lookups = 0;
          const RandomStream random{static_cast<uint>((z * n.y + y) * n.x + x), static_cast<uint>(l),
                                    context.scene.frame.seed};
          grid.tau.push_back(sample.shines()
                                 ? media_tau(context, {point, -sample.travel}, sample.distance, random, lookups)
                                 : dvec3(0));
        }
  return grid;
}

dvec3 light_grid_tau(const LightGrid& grid, const Medium& medium, std::size_t light, const dvec3& point) {
  const ivec3 n = points_of(medium);
  const dvec3 lo = vec_promote(medium.lo), hi = vec_promote(medium.hi);
  const dvec3 g = glm::clamp((affine_point(medium.cell_from_world, point) - lo) / (hi - lo), 0.0, 1.0) * dvec3(n - 1);
  const ivec3 first = glm::min(ivec3(glm::floor(g)), n - 2);
  const dvec3 w = g - dvec3(first);
  dvec3 tau(0);
  for (int corner = 0; corner < 8; ++corner) {
    const ivec3 d(corner & 1, corner >> 1 & 1, corner >> 2);
    const double weight = (d.x ? w.x : 1 - w.x) * (d.y ? w.y : 1 - w.y) * (d.z ? w.z : 1 - w.z);
    tau += weight * grid.tau[index_of(n, light, first + d)];
  }
  return tau;
}

}  // namespace brume::reference
