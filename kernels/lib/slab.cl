// Slab test [Kay86]: a ray cut to a box; for box shapes and for the region of a medium.
#ifndef BRUME_LIB_SLAB_CL
#define BRUME_LIB_SLAB_CL
#include "lib/vec.cl"

// One axis of [lo, hi]. A direction component of zero or nearly so is an inside test, so that 0 * inf never arises.
static inline int slab_cut(float lo, float hi, float o, float d, float* t0, float* t1) {
  const float inv_d = 1.0f / d;
  if (!(fabs(inv_d) < INFINITY)) {  // along a face is inside, also where rounding put it beside
    const float rounding = 2e-7f * (fabs(lo) + fabs(hi));
    return o >= lo - rounding && o <= hi + rounding;
  }
  const float a = (lo - o) * inv_d, b = (hi - o) * inv_d;
  *t0 = fmax_ordered(*t0, fmin_ordered(a, b));
  *t1 = fmin_ordered(*t1, fmax_ordered(a, b));
  return 1;
}

// Cuts [*t0, *t1] to the box; 0 when nothing is left.
static inline int box_cut(float3 lo, float3 hi, float3 o, float3 d, float* t0, float* t1) {
  return slab_cut(lo.x, hi.x, o.x, d.x, t0, t1) && slab_cut(lo.y, hi.y, o.y, d.y, t0, t1) &&
         slab_cut(lo.z, hi.z, o.z, d.z, t0, t1) && *t0 <= *t1;
}

// Both of W rays, to the same bits; 0 in the lanes where nothing is left.
static inline intW lanes_slab_cut(floatW lo, floatW hi, floatW o, floatW d, floatW* t0, floatW* t1) {
  const floatW inv_d = 1.0f / d, rounding = 2e-7f * (fabs(lo) + fabs(hi));
  const intW crosses = fabs(inv_d) < (floatW)(INFINITY);
  const floatW a = (lo - o) * inv_d, b = (hi - o) * inv_d;
  *t0 = lanes_select(*t0, fmax_ordered(*t0, fmin_ordered(a, b)), crosses);
  *t1 = lanes_select(*t1, fmin_ordered(*t1, fmax_ordered(a, b)), crosses);
  return crosses | ((o >= lo - rounding) & (o <= hi + rounding));
}

static inline intW lanes_box_cut(float3 lo, float3 hi, const LaneVectors* o, const LaneVectors* d, floatW* t0,
                                 floatW* t1) {
  return lanes_slab_cut((floatW)(lo.x), (floatW)(hi.x), o->v[0], d->v[0], t0, t1) &
         lanes_slab_cut((floatW)(lo.y), (floatW)(hi.y), o->v[1], d->v[1], t0, t1) &
         lanes_slab_cut((floatW)(lo.z), (floatW)(hi.z), o->v[2], d->v[2], t0, t1) & (*t0 <= *t1);
}

#endif
