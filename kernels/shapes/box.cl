// Slab test [Kay86], used for boxes and for the region of a medium.
#ifndef BRUME_SHAPES_BOX_CL
#define BRUME_SHAPES_BOX_CL
#include "lib/vec.cl"

// One axis of [lo, hi]. A zero direction component is an inside test, so that 0 * inf never arises.
static inline int slab_cut(float lo, float hi, float o, float d, float* t0, float* t1) {
  if (d == 0.0f) return o >= lo && o <= hi;
  const float inv_d = 1.0f / d;
  const float a = (lo - o) * inv_d, b = (hi - o) * inv_d;
  *t0 = fmax(*t0, fmin(a, b));
  *t1 = fmin(*t1, fmax(a, b));
  return 1;
}

// Cuts [*t0, *t1] to the box; 0 when nothing is left.
static inline int box_cut(float3 lo, float3 hi, float3 o, float3 d, float* t0, float* t1) {
  return slab_cut(lo.x, hi.x, o.x, d.x, t0, t1) && slab_cut(lo.y, hi.y, o.y, d.y, t0, t1) &&
         slab_cut(lo.z, hi.z, o.z, d.z, t0, t1) && *t0 <= *t1;
}

// Hit of the unit cube in its own space; t is the world's because the map is affine.
static inline float box_hit(const Affine* unit_from_world, float3 origin, float3 dir) {
  float t0 = -INFINITY, t1 = INFINITY;
  if (!box_cut((float3)(0.0f), (float3)(1.0f), affine_point(unit_from_world, origin), affine_dir(unit_from_world, dir),
               &t0, &t1))
    return INFINITY;
  return t0 > 0.0f ? t0 : (t1 > 0.0f ? t1 : INFINITY);
}

// Outward normal and uv of the face to which the point is nearest.
static inline float3 box_normal(const Affine* a, float3 point, float2* uv) {
  const float3 p = affine_point(a, point);
  const float3 d =
      (float3)(fmin(fabs(p.x), fabs(1.0f - p.x)), fmin(fabs(p.y), fabs(1.0f - p.y)), fmin(fabs(p.z), fabs(1.0f - p.z)));
  if (d.x <= d.y && d.x <= d.z) {
    *uv = p.yz;
    return normalize((float3)(a->m[0], a->m[1], a->m[2])) * (p.x < 0.5f ? -1.0f : 1.0f);
  }
  if (d.y <= d.z) {
    *uv = p.xz;
    return normalize((float3)(a->m[4], a->m[5], a->m[6])) * (p.y < 0.5f ? -1.0f : 1.0f);
  }
  *uv = p.xy;
  return normalize((float3)(a->m[8], a->m[9], a->m[10])) * (p.z < 0.5f ? -1.0f : 1.0f);
}

#endif
