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

// Coordinates (s, t) of p in corner + s u + t v, for p in the plane of u and v.
static inline float2 quad_coordinates(float3 u, float3 v, float3 from_corner) {
  const float3 n = cross(u, v);
  const float scale = 1.0f / dot(n, n);
  return (float2)(dot(cross(from_corner, v), n) * scale, dot(cross(u, from_corner), n) * scale);
}

static inline float quad_hit(float3 corner, float3 u, float3 v, float3 origin, float3 dir) {
  const float t = plane_hit(corner, cross(u, v), origin, dir);
  if (!(t < INFINITY)) return INFINITY;
  const float2 st = quad_coordinates(u, v, vec_point(origin, dir, t) - corner);
  return st.x >= 0.0f && st.x <= 1.0f && st.y >= 0.0f && st.y <= 1.0f ? t : INFINITY;
}

#endif
