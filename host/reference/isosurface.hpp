// The surface on which the density of a grid is iso: every cell along the ray is looked into, in double.
#pragma once
#include "reference/intersect.hpp"

namespace brume::reference {

// The nearest crossing with 0 < t < t_max; u and v as shared/ray.h says, no primitive.
HitD isosurface_hit(const PlannedScene& scene, const Isosurface& surface, const RayD& ray, double t_max);

// Outward normals at a hit of a ray in direction dir.
struct Normals {
  dvec3 geometric, shading;
};
Normals isosurface_normals(const PlannedScene& scene, const Isosurface& surface, const dvec3& point, const dvec3& dir,
                           const HitD& hit);

}  // namespace brume::reference
