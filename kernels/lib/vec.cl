// float3 helpers. Packed3 is what buffers hold, float3 what code computes with.
#ifndef BRUME_LIB_VEC_CL
#define BRUME_LIB_VEC_CL
#include "lib/lanes.cl"
#include "shared/platform.h"

#define PI_F 3.14159265358979f
#define INV_PI_F 0.318309886183791f

static inline float3 vec_unpack(Packed3 p) { return (float3)(p.x, p.y, p.z); }
static inline Packed3 vec_pack(float3 v) {
  Packed3 p;
  p.x = v.x;
  p.y = v.y;
  p.z = v.z;
  return p;
}
// Angle of (x, y) as a share of a turn, in [0, 1). Only textures ask for it.
static inline float azimuth(float y, float x) {
#if BRUME_TEXTURED
  const float turn = atan2(y, x) * (0.5f * INV_PI_F);
  return turn < 0.0f ? turn + 1.0f : turn;
#else
  return 0.0f;
#endif
}
static inline float vec_max_abs(float3 v) { return fmax(fmax(fabs(v.x), fabs(v.y)), fabs(v.z)); }
static inline float vec_mean(float3 v) { return (v.x + v.y + v.z) * (1.0f / 3.0f); }
static inline float vec_max(float3 v) { return fmax(fmax(v.x, v.y), v.z); }
static inline float vec_min(float3 v) { return fmin(fmin(v.x, v.y), v.z); }
// v with a largest component of 1, of a v so short or long that float does not hold its square.
static inline float3 vec_scaled(float3 v) { return v / fmax(vec_max_abs(v), FLT_MIN); }
static inline float3 vec_unit(float3 v) { return normalize(vec_scaled(v)); }
static inline float3 vec_point(float3 origin, float3 dir, float t) {
  return (float3)(mad_exact(t, dir.x, origin.x), mad_exact(t, dir.y, origin.y), mad_exact(t, dir.z, origin.z));
}
static inline float3 affine_point(const Affine* a, float3 p) {
  return (float3)(mad_exact(a->m[0], p.x, mad_exact(a->m[1], p.y, mad_exact(a->m[2], p.z, a->m[3]))),
                  mad_exact(a->m[4], p.x, mad_exact(a->m[5], p.y, mad_exact(a->m[6], p.z, a->m[7]))),
                  mad_exact(a->m[8], p.x, mad_exact(a->m[9], p.y, mad_exact(a->m[10], p.z, a->m[11]))));
}
static inline float3 affine_dir(const Affine* a, float3 d) {
  return (float3)(mad_exact(a->m[0], d.x, mad_exact(a->m[1], d.y, a->m[2] * d.z)),
                  mad_exact(a->m[4], d.x, mad_exact(a->m[5], d.y, a->m[6] * d.z)),
                  mad_exact(a->m[8], d.x, mad_exact(a->m[9], d.y, a->m[10] * d.z)));
}

// Components of W vectors.
typedef struct {
  floatW v[3];
} LaneVectors;

// Both of W vectors: components of points, or of directions.
static inline LaneVectors lanes_mapped(const Affine* a, const LaneVectors* v, int is_point) {
  LaneVectors r;
  for (int k = 0; k < 3; ++k) {
    const float* m = a->m + 4 * k;
    const floatW z = is_point ? mad_exact((floatW)(m[2]), v->v[2], (floatW)(m[3])) : m[2] * v->v[2];
    r.v[k] = mad_exact((floatW)(m[0]), v->v[0], mad_exact((floatW)(m[1]), v->v[1], z));
  }
  return r;
}

// A normal, or a gradient, of the space that the map leads to, in the one it comes from: by its transpose.
static inline float3 affine_normal(const Affine* a, float3 n) {
  return n.x * (float3)(a->m[0], a->m[1], a->m[2]) + n.y * (float3)(a->m[4], a->m[5], a->m[6]) +
         n.z * (float3)(a->m[8], a->m[9], a->m[10]);
}

// Unit vectors at right angles, of which z is given [Duff17].
typedef struct {
  float3 x, y, z;
} Frame3;

static inline Frame3 frame_about(float3 z) {
  const float sign = copysign(1.0f, z.z), a = -1.0f / (sign + z.z), b = z.x * z.y * a;
  Frame3 f;
  f.z = z;
  f.x = (float3)(1.0f + sign * z.x * z.x * a, sign * b, -sign * z.x);
  f.y = (float3)(b, sign + z.y * z.y * a, -z.y);
  return f;
}

// A sum of many terms that are small beside it, as exact as one of a few [Kahan65].
typedef struct {
  float3 sum, lost;
} LongSum;

static inline void long_sum_add(LongSum* s, float3 value) {
  const float3 term = value - s->lost, sum = s->sum + term;
  s->lost = (sum - s->sum) - term;
  s->sum = sum;
}

#endif
