// Sphere: nearest positive root of |o + t d - c|² = r².
#ifndef BRUME_SHAPES_SPHERE_CL
#define BRUME_SHAPES_SPHERE_CL
#include "lib/vec.cl"

// Both roots of a t² + 2 b t + c = 0 without cancellation; 0 when there are none. a > 0.
static inline int quadratic_roots(float a, float b, float c, float discriminant, float* t0, float* t1) {
  if (!(discriminant >= 0.0f)) return 0;
  const float root = sqrt(discriminant);
  const float q = -(b + copysign(root, b));
  const float r0 = q / a;
  const float r1 = q == 0.0f ? 0.0f : c / q;
  *t0 = fmin(r0, r1);
  *t1 = fmax(r0, r1);
  return 1;
}

// The discriminant comes from the distance of the centre to the ray, not from b² - ac: that difference loses everything for
// a far, small sphere [Haines19].
static inline float sphere_hit(float3 center, float radius, float3 origin, float3 dir) {
  const float3 f = origin - center;
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

#endif
