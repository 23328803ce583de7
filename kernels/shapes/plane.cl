// Unbounded plane and parallelogram.
#ifndef BRUME_SHAPES_PLANE_CL
#define BRUME_SHAPES_PLANE_CL
#include "lib/vec.cl"

static inline float plane_hit(float3 point, float3 normal, float3 origin, float3 dir) {
  const float facing = dot(normal, dir);
  if (facing == 0.0f) return INFINITY;  // parallel, beside the plane or in it: no hit
  const float t = dot(normal, point - origin) / facing;
  return t > 0.0f ? t : INFINITY;
}

// Coordinates (s, t) within the parallelogram, along the axes of shared/shape.h.
static inline float2 quad_coordinates(float3 s_axis, float3 t_axis, float3 from_corner) {
  return (float2)(dot(from_corner, s_axis), dot(from_corner, t_axis));
}

static inline float quad_hit(float3 corner, float3 normal, float3 s_axis, float3 t_axis, float3 origin, float3 dir) {
  const float t = plane_hit(corner, normal, origin, dir);
  if (!(t < INFINITY)) return INFINITY;
  const float2 st = quad_coordinates(s_axis, t_axis, vec_point(origin, dir, t) - corner);
  return st.x >= 0.0f && st.x <= 1.0f && st.y >= 0.0f && st.y <= 1.0f ? t : INFINITY;
}

#endif
