// See instances.hpp.
#include "reference/instances.hpp"

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "shared/ray.h"

namespace brume::reference {
namespace {

glm::dmat3 linear_of(const Affine& a) {
  return glm::transpose(glm::dmat3(vec_promote(a.m), vec_promote(a.m + 4), vec_promote(a.m + 8)));
}

const Triangle& record_of(const PlannedScene& scene, int primitive) {
  return scene.triangles[static_cast<std::size_t>(primitive - FIRST_TRIANGLE)];
}

}  // namespace

std::array<dvec3, 3> corners_in_world(const PlannedScene& scene, int primitive, int instance) {
  const Triangle& t = record_of(scene, primitive);
  std::array<dvec3, 3> p{vec_promote(t.p[0]), vec_promote(t.p[1]), vec_promote(t.p[2])};
  if (instance == INSTANCE_NONE) return p;
  for (dvec3& corner : p)
    corner = affine_point(scene.instances[static_cast<std::size_t>(instance)].world_from_mesh, corner);
  return p;
}

// A mirrored instance turns the corners around: what was its outer side stays it.
TriangleD triangle_in_world(const PlannedScene& scene, int primitive, int instance) {
  const Triangle& t = record_of(scene, primitive);
  const std::array<dvec3, 3> p = corners_in_world(scene, primitive, instance);
  TriangleD out{p, {}, vec_unit(glm::cross(p[1] - p[0], p[2] - p[0])), t.uv, t.material, t.shading};
  for (int k = 0; k < 3; ++k) out.n[k] = vec_promote(t.n[k]);
  if (instance == INSTANCE_NONE) return out;
  const Instance& where = scene.instances[static_cast<std::size_t>(instance)];
  const glm::dmat3 linear = linear_of(where.world_from_mesh);
  if (glm::determinant(linear) < 0) out.geometric_normal = -out.geometric_normal;
  if (t.shading != TRIANGLE_FLAT)
    for (dvec3& n : out.n) n = vec_unit(glm::transpose(glm::inverse(linear)) * n);
  if (where.material >= 0) out.material = where.material;
  return out;
}

RayD ray_in_mesh(const Instance& instance, const RayD& ray) {
  const glm::dmat3 back = glm::inverse(linear_of(instance.world_from_mesh));
  const float* m = instance.world_from_mesh.m;
  return {back * (ray.origin - dvec3(m[3], m[7], m[11])), back * ray.dir};
}

}  // namespace brume::reference
