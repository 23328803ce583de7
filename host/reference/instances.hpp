// Triangles where they stand: those of instances are taken to the world one by one, rays stay there.
#pragma once
#include <array>

#include "plan/render_plan.hpp"
#include "reference/vec.hpp"

namespace brume::reference {

struct TriangleD {
  std::array<dvec3, 3> p, n;  // n: unit, of triangles that are not flat
  dvec3 geometric_normal;     // unit
  const float* uv;            // as in Triangle
  int material, shading;
};

// `primitive` and `instance` as in shared/ray.h.
TriangleD triangle_in_world(const PlannedScene& scene, int primitive, int instance);

// Its corners alone.
std::array<dvec3, 3> corners_in_world(const PlannedScene& scene, int primitive, int instance);

// A ray as the mesh of an instance sees it, with the same t: to find out which triangles it may meet.
RayD ray_in_mesh(const Instance& instance, const RayD& ray);

}  // namespace brume::reference
