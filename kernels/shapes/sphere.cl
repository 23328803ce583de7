// Sphere: nearest positive root of |o + t d - c|² = r².
#ifndef BRUME_SHAPES_SPHERE_CL
#define BRUME_SHAPES_SPHERE_CL
#include "shapes/quadratic.cl"
#include "shapes/shape.cl"

// The discriminant comes from the distance of the centre to the ray, not from b² - ac: that difference loses everything
// for a far, small sphere [Haines19].
static inline float sphere_hit(const Shape* shape, float3 origin, float3 dir) {
  const float radius = shape->data[3];
  const float3 f = origin - shape_vec(shape, 0);
  const float b = dot(f, dir);
  const float3 perpendicular = f - b * dir;
  const float discriminant = mad_exact(radius, radius, -dot(perpendicular, perpendicular));
  float t0, t1;
  if (!quadratic_roots(1.0f, b, mad_exact(-radius, radius, dot(f, f)), discriminant, &t0, &t1)) return INFINITY;
  return t0 > 0.0f ? t0 : (t1 > 0.0f ? t1 : INFINITY);
}

static inline float2 sphere_uv(float3 normal) {
#if BRUME_TEXTURED
  return (float2)(azimuth(-normal.z, normal.x), 1.0f - acos(clamp(normal.y, -1.0f, 1.0f)) * INV_PI_F);
#else
  return (float2)(0.0f);
#endif
}

static inline float3 sphere_normal(const Shape* shape, float3 point, float2* uv) {
  const float3 n = normalize(point - shape_vec(shape, 0));
  *uv = sphere_uv(n);
  return n;
}

#endif
