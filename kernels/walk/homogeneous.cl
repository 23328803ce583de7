// homogeneous: constant density, no bricks. The optical depth is a product; light is sampled at equal steps.
#ifndef BRUME_WALK_HOMOGENEOUS_CL
#define BRUME_WALK_HOMOGENEOUS_CL
#include "walk/steps.cl"

static inline void homogeneous_fill(Steps* s, Segments* out) {
  int n = 0;
  for (; n < W && s->next < s->count; ++n, ++s->next) {
    out->begin[n] = (float)s->next * s->size;
    out->place[n] = ((float)s->next + 0.5f) * s->size;
    out->size[n] = s->size;
#if BRUME_RANDOM
    out->id[n] = (uint)s->next;
#endif
  }
  out->count = n;
  segments_pad(out);
}

static inline floatW homogeneous_integral(const Medium* medium, __global const Voxel* voxels, const MediumRay* ray,
                                          const Segments* at) {
  (void)voxels;
  (void)ray;
  return medium->constant_density * lanes_load(at->size);
}

static inline float homogeneous_total(const Medium* medium, const MediumRay* ray) {
  return ray->length > 0.0f ? medium->constant_density * ray->length : 0.0f;
}

#endif
