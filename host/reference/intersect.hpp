// Rays against surfaces, by brute force: every analytic shape, then every triangle. The BVH of the flat scene is not
// read.
#pragma once
#include <vector>

#include "plan/render_plan.hpp"
#include "reference/vec.hpp"

namespace brume::reference {

struct HitD {
  double t = INFINITE;
  int primitive = PRIMITIVE_NONE;  // as in shared/ray.h
  double u = 0, v = 0;             // as in shared/ray.h
  int instance = INSTANCE_NONE;    // as in shared/ray.h
};

// Boxes around runs of consecutive triangles and around instances, so that most of a mesh is skipped; they never change
// a result.
struct TriangleBounds {
  struct Run {
    dvec3 lo, hi;
    std::size_t begin, end;
    std::size_t inside = 0;  // runs that follow it and are parts of it; 0: its triangles are to be tried
  };
  // A run, its first half with all that is in it, its second half.
  using Runs = std::vector<Run>;
  explicit TriangleBounds(const PlannedScene& scene);
  Runs world;
  std::vector<Runs> meshes;    // in the space of each
  std::vector<Run> instances;  // begin: the number of the instance
};

// The nearest surface with 0 < t < t_max; of equals the first in the scene.
HitD nearest_hit(const PlannedScene& scene, const TriangleBounds& bounds, const RayD& ray, double t_max = INFINITE);
HitD nearest_hit(const PlannedScene& scene, const RayD& ray, double t_max = INFINITE);

// Whether any surface has 0 < t < t_max.
bool occluded(const PlannedScene& scene, const TriangleBounds& bounds, const RayD& ray, double t_max);
bool occluded(const PlannedScene& scene, const RayD& ray, double t_max);

}  // namespace brume::reference
