// Placement of the marchers: n equal steps over the whole stretch inside the medium, each sampled at the same share of it;
// those sampled in an empty brick are skipped without being touched.
#ifndef BRUME_TRANSMITTANCE_STEPS_CL
#define BRUME_TRANSMITTANCE_STEPS_CL
#include "lib/dda.cl"

typedef struct {
  int next, count;
  float size;   // world length of a step
  float share;  // of a step before its sample: 0.5 for the middle, 0 where it begins
} Steps;

// n = ceil(length / step - 1/1024): the step is renormalised to length / n (ARCHITECTURE, Media).
static inline Steps steps_begin(const Medium* medium, const MediumRay* ray, float share) {
  Steps s;
  s.share = share;
  s.next = 0;
  s.count = ray->length > 0.0f ? max(1, (int)ceil(ray->length / medium->step - 0x1p-10f)) : 0;
  s.size = ray->length / (float)max(s.count, 1);
  return s;
}

static inline void steps_fill(const Medium* medium, __global const int* bricks, Dda* d, Steps* s, Segments* out) {
  out->count = 0;
  while (out->count < W && s->next < s->count) {
    const float place = ((float)s->next + s->share) * s->size;
    if (place < d->brick_end) {
      const int i = out->count++;
      out->place[i] = place;
      out->size[i] = s->size;
      out->base[i] = d->base;
      out->x[i] = d->x.brick * BRICK_CELLS;
      out->y[i] = d->y.brick * BRICK_CELLS;
      out->z[i] = d->z.brick * BRICK_CELLS;
      ++s->next;
      continue;
    }
    d->s = d->brick_end;
    if (!dda_next_brick(medium, bricks, d)) {
      s->next = s->count;
    } else {
      s->next = max(s->next, (int)ceil(d->s / s->size - s->share));
    }
  }
}

#endif
