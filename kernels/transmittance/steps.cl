// Placement of the marchers: n equal steps over the whole stretch inside the medium, each sampled once; those sampled in an
// empty brick are skipped without being touched.
#ifndef BRUME_TRANSMITTANCE_STEPS_CL
#define BRUME_TRANSMITTANCE_STEPS_CL
#include "lib/dda.cl"
#include "lib/rng.cl"

typedef struct {
  int next, count;
  float size;   // world length of a step
  float share;  // of a step before its sample: 0.5 for the middle, 0 where it begins
#if BRUME_JITTER
  float jitter;  // of a step: its sample lies anywhere from `share` on over this much
  Random random;
#endif
} Steps;

// n = ceil(length / step - 1/1024): the step is renormalised to length / n (ARCHITECTURE, Media).
static inline Steps steps_begin(const Medium* medium, const MediumRay* ray, Random random, float share, float jitter) {
  Steps s;
  s.share = share;
#if BRUME_JITTER
  s.jitter = jitter;
  s.random = random;
#endif
  s.next = 0;
  s.count = ray->length > 0.0f ? max(1, (int)ceil(ray->length / medium->step - 0x1p-10f)) : 0;
  s.size = ray->length / (float)max(s.count, 1);
  return s;
}

static inline float steps_place(const Steps* s) {
  float share = s->share;
#if BRUME_JITTER
  if (s->jitter > 0.0f) share = mad_exact(s->jitter, random_at(&s->random, (uint)s->next, RANDOM_PLACE), share);
#endif
  return ((float)s->next + share) * s->size;
}

static inline void steps_fill(const Scene* scene, const Medium* medium, Dda* d, Steps* s, Segments* out) {
  out->count = 0;
  while (out->count < W && s->next < s->count) {
    const float place = steps_place(s);
    if (place < d->s && d->begun) {  // in the empty stretch that was skipped
      ++s->next;
    } else if (place < d->brick_end) {
      const int i = out->count++;
      out->place[i] = place;
      out->size[i] = s->size;
      dda_brick_store(d, i, out);
      out->x[i] = d->x.brick * BRICK_CELLS;
      out->y[i] = d->y.brick * BRICK_CELLS;
      out->z[i] = d->z.brick * BRICK_CELLS;
#if BRUME_RANDOM
      out->id[i] = (uint)s->next;
#endif
      ++s->next;
    } else {
      d->s = d->brick_end;
      if (!dda_next_brick(scene, medium, d)) {
        s->next = s->count;
      } else {
        s->next = max(s->next, (int)(d->s / s->size) - 1);  // the step in which the brick begins, or the one before
      }
    }
  }
}

#endif
