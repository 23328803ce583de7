// Unbounded plane.
#ifndef BRUME_SHAPES_PLANE_CL
#define BRUME_SHAPES_PLANE_CL
#include "shapes/shape.cl"

// Point and normal are the first six numbers of a plane and of a quad.
static inline float plane_hit(const Shape* shape, float3 origin, float3 dir) {
  const float3 normal = shape_vec(shape, 3);
  const float facing = dot(normal, dir);
  if (facing == 0.0f) return INFINITY;  // parallel, beside the plane or in it: no hit
  const float t = dot(normal, shape_vec(shape, 0) - origin) / facing;
  return t > 0.0f ? t : INFINITY;
}

static inline float3 plane_normal(const Shape* shape, float3 point, int textured, float2* uv) {
  const float3 n = shape_vec(shape, 3), u = shape_vec(shape, 6), from = point - shape_vec(shape, 0);
  if (textured) *uv = (float2)(dot(from, u), dot(from, cross(n, u)));
  return n;
}

// Unbounded: no light.
static inline ShapePlace plane_emit(const Shape* shape, float3 from, float2 xi) {
  (void)xi;
  return shape_place_of(shape_vec(shape, 0) - from, shape_vec(shape, 3), 0.0f);
}

#endif
