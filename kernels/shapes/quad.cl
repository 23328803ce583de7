// Parallelogram.
#ifndef BRUME_SHAPES_QUAD_CL
#define BRUME_SHAPES_QUAD_CL
#include "shapes/plane.cl"

// Coordinates (s, t) within the parallelogram, along the axes of shared/shape.h.
static inline float2 quad_coordinates(const Shape* shape, float3 point) {
  const float3 from_corner = point - shape_vec(shape, 0);
  return (float2)(dot(from_corner, shape_vec(shape, 6)), dot(from_corner, shape_vec(shape, 9)));
}

static inline float quad_hit(const Shape* shape, float3 origin, float3 dir) {
  const float t = plane_hit(shape, origin, dir);
  if (!(t < INFINITY)) return INFINITY;
  const float2 st = quad_coordinates(shape, vec_point(origin, dir, t));
  return st.x >= 0.0f && st.x <= 1.0f && st.y >= 0.0f && st.y <= 1.0f ? t : INFINITY;
}

static inline float3 quad_normal(const Shape* shape, float3 point, int textured, float2* uv) {
  if (textured) *uv = quad_coordinates(shape, point);
  return shape_vec(shape, 3);
}

static inline ShapePlace quad_emit(const Shape* shape, float3 from, float2 xi) {
  const float3 n = shape_vec(shape, 3), s = shape_vec(shape, 6), t = shape_vec(shape, 9);
  const float3 along = cross(t, n), across = cross(n, s);
  const float3 u = along / dot(s, along), v = across / dot(t, across);
  return shape_place_of(shape_vec(shape, 0) - from + xi.x * u + xi.y * v, n, length(cross(u, v)));
}

#endif
