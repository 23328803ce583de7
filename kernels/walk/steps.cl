// Placement of the marchers: n equal steps over the whole ray inside the medium, each sampled once, W side by side.
// Which brick a sample lies in follows from where it is; bricks are walked through only where W samples find none.
#ifndef BRUME_WALK_STEPS_CL
#define BRUME_WALK_STEPS_CL
#include "density/dda.cl"
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

// n = ceil(length / step - 1/1024): the step is renormalised to length / n (PICTURE, Segments).
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

// s of the samples of these steps.
static inline floatW steps_place(const Steps* s, floatW number) {
  floatW share = (floatW)(s->share);
#if BRUME_JITTER
  if (s->jitter > 0.0f) {
    float random[W];
    for (int i = 0; i < W; ++i) random[i] = random_at(&s->random, (uint)(s->next + i), RANDOM_PLACE);
    share = mad_exact((floatW)(s->jitter), lanes_load(random), share);
  }
#endif
  return (number + share) * s->size;
}

static inline floatW steps_brick(floatW place, float origin, float dir, int bricks) {
  const floatW p = mad_exact(place, (floatW)(dir), (floatW)(origin));
  return fmin(fmax(floor(p * (1.0f / BRICK_CELLS)), (floatW)(0.0f)), (floatW)((float)(bricks - 1)));
}

// The first step worth a look after W steps from `next` on were all in empty bricks: the one in which the next stored
// brick begins, or the one before.
static inline int steps_skip(const Scene* scene, const Medium* medium, const MediumRay* ray, const Steps* s) {
  Dda d = dda_begin(medium, ray, (float)(s->next + W - 1) * s->size);
  if (!dda_next_brick(scene, medium, &d)) return s->count;
  return max(s->next + W, (int)(d.s / s->size) - 1);
}

static inline void steps_fill(const Scene* scene, const Medium* medium, const MediumRay* ray, Steps* s, Segments* out) {
  out->count = 0;
  while (s->next < s->count) {
    const floatW number = (floatW)((float)s->next) + lanes_iota(), place = steps_place(s, number);
    const floatW bx = steps_brick(place, ray->origin.x, ray->dir.x, medium->brick_nx);
    const floatW by = steps_brick(place, ray->origin.y, ray->dir.y, medium->brick_ny);
    const floatW bz = steps_brick(place, ray->origin.z, ray->dir.z, medium->brick_nz);
    const intW x = lanes_to_int(bx), y = lanes_to_int(by), z = lanes_to_int(bz);
    const intW entry = brick_entries(scene, medium, x, y, z);
    const intW used = (number < (floatW)((float)s->count)) & (entry != (intW)(BRICK_EMPTY));
    if (!lanes_any(used)) {
      s->next = steps_skip(scene, medium, ray, s);
      continue;
    }
    // A lane that is not used looks into brick 0, for nothing.
    const intW brick = lanes_select((intW)(0), entry, used);
    lanes_store(number * s->size, out->begin);
    lanes_store(place, out->place);
    lanes_store(lanes_select((floatW)(0.0f), (floatW)(s->size), used), out->size);
    lanes_store(brick_base(brick, x, y, z), out->base);
    lanes_store(bx * BRICK_CELLS, out->x);
    lanes_store(by * BRICK_CELLS, out->y);
    lanes_store(bz * BRICK_CELLS, out->z);
    out->count = (int)lanes_sum(lanes_select((floatW)(0.0f), (floatW)(1.0f), used));
#if BRUME_STORAGE == 2
    brick_scales(scene, brick, out->zero, out->part);
#endif
#if BRUME_RANDOM
    for (int i = 0; i < W; ++i) out->id[i] = (uint)(s->next + i);
#endif
    s->next += W;
    return;
  }
}

#endif
