// The hits of all shapes. Each *_hit returns the smallest t > 0, or infinity. See kernels/shared/shape.h for the data
// of a shape.
#include "reference/intersect.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "reference/instances.hpp"
#include "reference/isosurface.hpp"

namespace brume::reference {
namespace {

double smaller_positive(double a, double b) {
  if (!(a > 0)) a = INFINITE;
  if (!(b > 0)) b = INFINITE;
  return std::min(a, b);
}

double sphere_hit(const float* data, const RayD& ray) {
  const dvec3 from_center = ray.origin - vec_promote(data);
  const double radius = data[3];
  const double b = glm::dot(from_center, ray.dir);
  // squared distance of the line from the center without the cancellation of b² - c
  const dvec3 closest = from_center - b * ray.dir;
  const double discriminant = radius * radius - glm::dot(closest, closest);
  if (discriminant < 0) return INFINITE;
  const double root = std::sqrt(discriminant);
  return smaller_positive(-b - root, -b + root);
}

double cylinder_hit(const float* data, const RayD& ray) {
  const dvec3 from_base = ray.origin - vec_promote(data), axis = vec_unit(vec_promote(data + 3));
  const double height = data[6], radius = data[7];
  const double z = glm::dot(from_base, axis), dz = glm::dot(ray.dir, axis);
  const dvec3 across = from_base - z * axis, dir_across = ray.dir - dz * axis;
  const double a = glm::dot(dir_across, dir_across);

  double t = INFINITE;
  if (a > 0) {  // the side
    const double middle = -glm::dot(across, dir_across) / a;
    const dvec3 closest = across + middle * dir_across;
    const double discriminant = (radius * radius - glm::dot(closest, closest)) / a;
    if (discriminant >= 0) {
      const double root = std::sqrt(discriminant);
      for (const double side : {middle - root, middle + root})
        if (z + side * dz >= 0 && z + side * dz <= height) t = smaller_positive(t, side);
    }
  }
  if (dz != 0)
    for (const double cap_z : {0.0, height}) {
      const double cap = (cap_z - z) / dz;
      const dvec3 p = across + cap * dir_across;
      if (glm::dot(p, p) <= radius * radius) t = smaller_positive(t, cap);
    }
  return t;
}

double plane_hit(const float* data, const RayD& ray) {
  const dvec3 normal = vec_unit(vec_promote(data + 3));
  const double slope = glm::dot(ray.dir, normal);
  if (slope == 0) return INFINITE;
  return smaller_positive(glm::dot(vec_promote(data) - ray.origin, normal) / slope, INFINITE);
}

double quad_hit(const float* data, const RayD& ray) {
  const dvec3 corner = vec_promote(data), normal = vec_unit(vec_promote(data + 3));
  const double slope = glm::dot(ray.dir, normal);
  if (slope == 0) return INFINITE;
  const double t = glm::dot(corner - ray.origin, normal) / slope;
  const dvec3 p = ray.at(t) - corner;
  const double s = glm::dot(p, vec_promote(data + 6)), r = glm::dot(p, vec_promote(data + 9));
  const bool inside = s >= 0 && s <= 1 && r >= 0 && r <= 1;
  return inside ? smaller_positive(t, INFINITE) : INFINITE;
}

// [t0, t1] within the box lo..hi; t0 > t1 for a miss. A ray along a face lies in the box.
struct Span {
  double t0, t1;
};
Span box_span(const dvec3& lo, const dvec3& hi, const dvec3& origin, const dvec3& dir) {
  Span span{-INFINITE, INFINITE};
  for (int axis = 0; axis < 3; ++axis) {
    if (dir[axis] == 0) {
      if (origin[axis] < lo[axis] || origin[axis] > hi[axis]) return {INFINITE, -INFINITE};
      continue;
    }
    const double a = (lo[axis] - origin[axis]) / dir[axis], b = (hi[axis] - origin[axis]) / dir[axis];
    span = {std::max(span.t0, std::min(a, b)), std::min(span.t1, std::max(a, b))};
  }
  return span;
}

double box_hit(const float* data, const RayD& ray) {
  Affine unit_from_world;
  std::copy(data, data + 12, unit_from_world.m);
  const Span span = box_span(dvec3(0), dvec3(1), affine_point(unit_from_world, ray.origin),
                             affine_direction(unit_from_world, ray.dir));
  return span.t0 <= span.t1 ? smaller_positive(span.t0, span.t1) : INFINITE;
}

using ShapeHit = double (*)(const float* data, const RayD& ray);
constexpr ShapeHit SHAPE_HITS[] = {sphere_hit, cylinder_hit, plane_hit, quad_hit, box_hit};
static_assert(std::size(SHAPE_HITS) == SHAPE_ISOSURFACE && SHAPE_ISOSURFACE + 1 == SHAPE_COUNT,
              "one row per closed form, in the order of ShapeType");

// [MoellerTrumbore97]; edges belong to both neighbours.
HitD triangle_hit(const std::array<dvec3, 3>& corners, const RayD& ray) {
  const dvec3 p0 = corners[0], e1 = corners[1] - p0, e2 = corners[2] - p0;
  const dvec3 across = glm::cross(ray.dir, e2);
  const double determinant = glm::dot(e1, across);
  if (determinant == 0) return {};
  const dvec3 from_p0 = ray.origin - p0;
  const double u = glm::dot(from_p0, across) / determinant;
  if (u < 0 || u > 1) return {};
  const dvec3 turned = glm::cross(from_p0, e1);
  const double v = glm::dot(ray.dir, turned) / determinant;
  if (v < 0 || u + v > 1) return {};
  const double t = glm::dot(e2, turned) / determinant;
  return t > 0 ? HitD{t, PRIMITIVE_NONE, u, v} : HitD{};
}

void triangles_hit(const PlannedScene& scene, std::size_t begin, std::size_t end, int instance, const RayD& ray,
                   HitD& nearest) {
  for (std::size_t i = begin; i < end; ++i) {
    const int primitive = FIRST_TRIANGLE + static_cast<int>(i);
    HitD hit = triangle_hit(corners_in_world(scene, primitive, instance), ray);
    if (!(hit.t < nearest.t)) continue;
    hit.primitive = primitive;
    hit.instance = instance;
    nearest = hit;
  }
}

// `inverse` of the ray's direction. A ray along an axis gives infinities; on a face it gives NaN, which bounds nothing.
bool may_meet(const TriangleBounds::Run& run, const RayD& ray, const dvec3& inverse, double t_max) {
  double t0 = 0, t1 = t_max;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (run.lo[axis] - ray.origin[axis]) * inverse[axis];
    const double b = (run.hi[axis] - ray.origin[axis]) * inverse[axis];
    t0 = std::max(t0, std::min(a, b));
    t1 = std::min(t1, std::max(a, b));
  }
  return t0 <= t1;
}

// Of runs, in the space of the ray.
void runs_hit(const PlannedScene& scene, const TriangleBounds::Runs& runs, int instance, const RayD& here,
              const RayD& ray, HitD& nearest) {
  const dvec3 inverse = 1.0 / here.dir;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const TriangleBounds::Run& run = runs[i];
    if (!may_meet(run, here, inverse, nearest.t))
      i += run.inside;
    else if (run.inside == 0)
      triangles_hit(scene, run.begin, run.end, instance, ray, nearest);
  }
}

void instance_hit(const PlannedScene& scene, const TriangleBounds& bounds, int instance, const RayD& ray,
                  HitD& nearest) {
  const Instance& where = scene.instances[static_cast<std::size_t>(instance)];
  runs_hit(scene, bounds.meshes[static_cast<std::size_t>(where.mesh)], instance, ray_in_mesh(where, ray), ray, nearest);
}

HitD shapes_hit(const PlannedScene& scene, const RayD& ray, double t_max) {
  HitD nearest{t_max};
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    const Shape& shape = scene.shapes[i];
    HitD hit;
    if (shape.type == SHAPE_ISOSURFACE)
      hit = isosurface_hit(scene, scene.isosurfaces[static_cast<std::size_t>(shape.data[0])], ray, nearest.t);
    else
      hit.t = SHAPE_HITS[shape.type](shape.data, ray);
    hit.primitive = static_cast<int>(i);
    if (hit.t < nearest.t) nearest = hit;
  }
  return nearest;
}

void run_add(TriangleBounds::Run& run, const dvec3& p) {
  run.lo = glm::min(run.lo, p);
  run.hi = glm::max(run.hi, p);
}

// By a hair more than any rounding of the tests.
void run_widen(TriangleBounds::Run& run) {
  const dvec3 margin = 1e-9 * glm::max(glm::abs(run.lo), glm::abs(run.hi)) + 1e-9 * (run.hi - run.lo);
  run.lo -= margin;
  run.hi += margin;
}

void runs_add(const PlannedScene& scene, std::size_t begin, std::size_t end, TriangleBounds::Runs& runs) {
  constexpr std::size_t tried_together = 4;
  const std::size_t its = runs.size();
  TriangleBounds::Run run{dvec3(INFINITE), dvec3(-INFINITE), begin, end};
  for (std::size_t i = begin; i < end; ++i)
    for (const Packed3& p : scene.triangles[i].p) run_add(run, vec_promote(p));
  run_widen(run);
  runs.push_back(run);
  if (end - begin <= tried_together) return;
  const std::size_t middle = begin + (end - begin) / 2;
  runs_add(scene, begin, middle, runs);
  runs_add(scene, middle, end, runs);
  runs[its].inside = runs.size() - its - 1;
}

TriangleBounds::Runs runs_of(const PlannedScene& scene, std::size_t first, std::size_t count) {
  TriangleBounds::Runs runs;
  if (count > 0) runs_add(scene, first, first + count, runs);
  return runs;
}

HitD hit_or_miss(const HitD& nearest) { return nearest.primitive == PRIMITIVE_NONE ? HitD{} : nearest; }

}  // namespace

TriangleBounds::TriangleBounds(const PlannedScene& scene) : world(runs_of(scene, 0, scene.world_triangles())) {
  for (const FlatMesh& mesh : scene.meshes)
    meshes.push_back(runs_of(scene, static_cast<std::size_t>(mesh.first), static_cast<std::size_t>(mesh.count)));
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Runs& runs = meshes[static_cast<std::size_t>(scene.instances[i].mesh)];
    const Run mesh = runs.empty() ? Run{dvec3(INFINITE), dvec3(-INFINITE), 0, 0} : runs.front();
    Run all{dvec3(INFINITE), dvec3(-INFINITE), i, i + 1};
    for (int c = 0; c < 8; ++c)
      run_add(all, affine_point(
                       scene.instances[i].world_from_mesh,
                       {(c & 1 ? mesh.hi : mesh.lo).x, (c & 2 ? mesh.hi : mesh.lo).y, (c & 4 ? mesh.hi : mesh.lo).z}));
    run_widen(all);
    instances.push_back(all);
  }
}

HitD nearest_hit(const PlannedScene& scene, const TriangleBounds& bounds, const RayD& ray, double t_max) {
  HitD nearest = shapes_hit(scene, ray, t_max);
  runs_hit(scene, bounds.world, INSTANCE_NONE, ray, ray, nearest);
  for (const TriangleBounds::Run& run : bounds.instances)
    if (may_meet(run, ray, 1.0 / ray.dir, nearest.t))
      instance_hit(scene, bounds, static_cast<int>(run.begin), ray, nearest);
  return hit_or_miss(nearest);
}

HitD nearest_hit(const PlannedScene& scene, const RayD& ray, double t_max) {
  HitD nearest = shapes_hit(scene, ray, t_max);
  triangles_hit(scene, 0, scene.world_triangles(), INSTANCE_NONE, ray, nearest);
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const FlatMesh& mesh = scene.meshes[static_cast<std::size_t>(scene.instances[i].mesh)];
    const auto begin = static_cast<std::size_t>(mesh.first), end = begin + static_cast<std::size_t>(mesh.count);
    triangles_hit(scene, begin, end, static_cast<int>(i), ray, nearest);
  }
  return hit_or_miss(nearest);
}

bool occluded(const PlannedScene& scene, const TriangleBounds& bounds, const RayD& ray, double t_max) {
  return nearest_hit(scene, bounds, ray, t_max).primitive != PRIMITIVE_NONE;
}

bool occluded(const PlannedScene& scene, const RayD& ray, double t_max) {
  return nearest_hit(scene, ray, t_max).primitive != PRIMITIVE_NONE;
}

}  // namespace brume::reference
