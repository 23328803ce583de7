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

// The first step worth a look after W steps from `next` on were all in empty bricks: the one in which the next stored
// brick begins, or the one before.
OUTLINED int steps_skip(const Scene* scene, const Medium* medium, const MediumRay* ray, const Steps* s) {
  Dda d = dda_begin(medium, ray, (float)(s->next + W - 1) * s->size);
  if (!dda_next_brick(scene, medium, &d)) return s->count;
  return max(s->next + W, (int)(d.s / s->size) - 1);
}

// W steps side by side.
typedef struct {
  floatW number, place;  // s of the sample
  intW x, y, z;          // brick of the sample
  intW entry, used;      // its brick is stored; the entry is 0 where it is not
} StepBatch;

// The next W steps of which one is used; 0 at the end.
__attribute__((always_inline)) static inline int steps_next(const Scene* scene, const Medium* medium,
                                                            const MediumRay* ray, Steps* s, StepBatch* out) {
  while (s->next < s->count) {
    out->number = (floatW)((float)s->next) + lanes_iota();
    out->place = steps_place(s, out->number);
    out->x = lanes_brick(out->place, ray->origin.x, ray->dir.x, medium->brick_nx);
    out->y = lanes_brick(out->place, ray->origin.y, ray->dir.y, medium->brick_ny);
    out->z = lanes_brick(out->place, ray->origin.z, ray->dir.z, medium->brick_nz);
    const intW entry = brick_entries_along(scene, medium, out->x, out->y, out->z);
    out->used = (out->number < (floatW)((float)s->count)) & (entry != (intW)(BRICK_EMPTY));
    if (lanes_any(out->used)) {
      out->entry = lanes_select((intW)(0), entry, out->used);
      s->next += W;
      return 1;
    }
    s->next = steps_skip(scene, medium, ray, s);
  }
  return 0;
}

static inline int steps_used(const StepBatch* b) {
  return (int)lanes_sum(lanes_select((floatW)(0.0f), (floatW)(1.0f), b->used));
}

static inline void steps_fill(const Scene* scene, const Medium* medium, const MediumRay* ray, Steps* s, Segments* out) {
  StepBatch b;
  out->count = 0;
  if (!steps_next(scene, medium, ray, s, &b)) return;
  lanes_store(b.number * s->size, out->begin);
  lanes_store(b.place, out->place);
  lanes_store(lanes_select((floatW)(0.0f), (floatW)(s->size), b.used), out->size);
  lanes_store(brick_base(b.entry, b.x, b.y, b.z), out->base);
  lanes_store(lanes_to_float(b.x * BRICK_CELLS), out->x);
  lanes_store(lanes_to_float(b.y * BRICK_CELLS), out->y);
  lanes_store(lanes_to_float(b.z * BRICK_CELLS), out->z);
  out->count = steps_used(&b);
#if BRUME_STORAGE == 2
  brick_scales(scene, b.entry, out->zero, out->part);
#endif
#if BRUME_RANDOM
  for (int i = 0; i < W; ++i) out->id[i] = (uint)(s->next - W + i);
#endif
}

// ∫ρ over what is left of the steps, until it is black by an extinction of `sigma`: steps_fill and march_integral
// without the segments between them, which nobody else asks for.
static inline float steps_total(const Scene* scene, const Medium* medium, const MediumRay* ray, Steps* s, float sigma,
                                uint* lookups) {
  StepBatch b;
  float total = 0.0f;
  while (total * sigma < TAU_STOP && steps_next(scene, medium, ray, s, &b)) {
    const Lookup l = lookup_from(ray, b.place, lanes_to_float(b.x * BRICK_CELLS), lanes_to_float(b.y * BRICK_CELLS),
                                 lanes_to_float(b.z * BRICK_CELLS), b.entry * BRICK_VALUES, WITHIN_BRICK);
    const floatW density = brick_density(scene, b.entry, lookup_value(medium, scene->voxels, &l));
    total += lanes_sum(lanes_select((floatW)(0.0f), density * s->size, b.used));
    *lookups += (uint)steps_used(&b);
  }
  return total;
}

#endif
