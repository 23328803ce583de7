// The dispatcher over shapes: nearest hit, any hit, and what the surface is at a hit.
#ifndef BRUME_SHAPES_SHAPES_CL
#define BRUME_SHAPES_SHAPES_CL
#include "lib/scene.cl"
#include "shapes/box.cl"
#include "shapes/bvh.cl"
#include "shapes/cylinder.cl"
#include "shapes/plane.cl"
#include "shapes/sphere.cl"

#define PLANE_MARGIN 0x1p-5f  // of the distance to a plane: how far before it a ray starts

static inline float3 shape_vec(const Shape* shape, int i) {
  return (float3)(shape->data[i], shape->data[i + 1], shape->data[i + 2]);
}

static inline Affine shape_affine(const Shape* shape) {
  Affine a;
  for (int i = 0; i < 12; ++i) a.m[i] = shape->data[i];
  return a;
}

static inline float shape_hit(const Shape* shape, float3 origin, float3 dir) {
  const int type = shape->type;
  if (USES_SHAPE(SPHERE) && type == SHAPE_SPHERE) return sphere_hit(shape_vec(shape, 0), shape->data[3], origin, dir);
  if (USES_SHAPE(CYLINDER) && type == SHAPE_CYLINDER) {
    const Cylinder c = cylinder_load(shape);
    return cylinder_hit(&c, origin, dir);
  }
  if (USES_SHAPE(PLANE) && type == SHAPE_PLANE) return plane_hit(shape_vec(shape, 0), shape_vec(shape, 3), origin, dir);
  if (USES_SHAPE(QUAD) && type == SHAPE_QUAD)
    return quad_hit(shape_vec(shape, 0), shape_vec(shape, 3), shape_vec(shape, 6), shape_vec(shape, 9), origin, dir);
  if (USES_SHAPE(BOX) && type == SHAPE_BOX) {
    const Affine a = shape_affine(shape);
    return box_hit(&a, origin, dir);
  }
  return INFINITY;
}

// Nearest surface with 0 < t < t_max; `any`: the first one found will do.
static inline Hit scene_hit(const Scene* scene, float3 origin, float3 dir, float t_max, int any) {
  Hit hit;
  hit.t = t_max;
  hit.primitive = PRIMITIVE_NONE;
  hit.u = 0.0f;
  hit.v = 0.0f;
#if BRUME_SHAPES_USED
  for (int i = 0; i < scene->frame->shape_count; ++i) {
    const Shape shape = scene->shapes[i];
    const float t = shape_hit(&shape, origin, dir);
    if (!(t < hit.t)) continue;
    hit.t = t;
    hit.primitive = i;
    if (any) return hit;
  }
#endif
#if BRUME_TRIANGLES
  bvh_hit(scene, origin, dir, any, &hit);
#endif
  return hit;
}

// A camera ray that starts at the scene's bounds may have passed a plane on its way there, which has no bounds: back to before it.
static inline void ray_start_before_planes(const Scene* scene, Ray* ray) {
  if (!USES_SHAPE(PLANE)) return;
  const float3 origin = vec_unpack(ray->origin), dir = vec_unpack(ray->dir);
  float t = 0.0f;
  for (int i = 0; i < scene->frame->shape_count; ++i) {
    const Shape shape = scene->shapes[i];
    if (shape.type != SHAPE_PLANE) continue;
    const float3 normal = shape_vec(&shape, 3);
    const float back = dot(normal, origin - shape_vec(&shape, 0)) / dot(normal, dir);  // not finite: beside the plane
    if (back >= 0.0f && back < ray->start) t = fmin(t, -fmin(ray->start, back + PLANE_MARGIN * fmax(1.0f, back)));
  }
  ray->origin = vec_pack(vec_point(origin, dir, t));
  ray->start += t;
}

static inline int scene_occluded(const Scene* scene, float3 origin, float3 dir, float t_max) {
#if HAS_SURFACES
  return scene_hit(scene, origin, dir, t_max, 1).primitive != PRIMITIVE_NONE;
#else
  return 0;
#endif
}

#endif
