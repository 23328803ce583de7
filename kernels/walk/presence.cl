// Placement and rule of `march_linear`: equal steps through a liquid, whose presence is looked up where they meet, at
// borders, and taken to be linear between them (PICTURE, Liquids). Bricks of one value and those that stay below
// `outside` are passed over: the borders next to them say all about the way between, and a step there is as long as
// that.
#ifndef BRUME_WALK_PRESENCE_CL
#define BRUME_WALK_PRESENCE_CL
#include "density/dda.cl"

#if BRUME_LIQUID

// Rays that go more along the planes of slices than this, as a cosine, take equal steps.
#define SLICES_ALONG 0.125f

// Borders are numbered: 0 where the ray enters the medium, `last` at its end.
typedef struct {
  Dda dda;
  float outside;
  float size, offset;  // length of a step; s of border 1
  float inv_size;
  float length;
  int last;
  int next, stop;     // borders that are to be looked up; none where next > stop
  int begun;          // the first is known
  int filled;         // the presence goes on without change behind `stop`
  int started;        // there is a border before:
  float s, presence;  // where it is, and its presence
} Presence;

static inline int presence_border_before(const Presence* w, float s) {
  return clamp((int)floor((s - w->offset) * w->inv_size) + 1, 0, w->last);
}

static inline int presence_border_after(const Presence* w, float s) {
  return clamp((int)ceil((s - w->offset) * w->inv_size) + 1, 0, w->last);
}

static inline floatW presence_border(const Presence* w, floatW number) {
  const floatW s = mad_exact(number - 1.0f, (floatW)(w->size), (floatW)(w->offset));
  return fmin_ordered(fmax_ordered(s, (floatW)(0.0f)), (floatW)(w->length));
}

// Steps from plane to plane across the view; 0 for a ray along them.
static inline int presence_slice(const Scene* scene, const Medium* medium, const MediumRay* ray, Presence* w) {
  const float3 forward = vec_unpack(scene->frame->camera.forward);
  const float across = dot(forward, affine_dir(&medium->world_from_cell, ray->dir));
  if (!medium->slices || !(fabs(across) >= SLICES_ALONG)) return 0;
  const float plane = dot(forward, affine_point(&medium->world_from_cell, ray->origin)) / medium->step;
  w->size = medium->step / fabs(across);
  w->offset = w->size * (across > 0.0f ? floor(plane) + 1.0f - plane : plane - ceil(plane) + 1.0f);
  w->last = 1 + max((int)ceil((ray->length - w->offset) / w->size), 0);
  return 1;
}

static inline Presence presence_begin(const Scene* scene, const Medium* medium, const MediumRay* ray) {
  Presence w;
  w.outside = scene->liquids[medium->liquid].outside;
  w.length = ray->length;
  if (!presence_slice(scene, medium, ray, &w)) {
    w.last = max(1, (int)ceil(ray->length / medium->step - 0x1p-10f));
    w.size = w.offset = ray->length / (float)w.last;
  }
  w.inv_size = 1.0f / w.size;
  w.dda = dda_begin(medium, ray, 0.0f);
  w.next = 0;
  w.stop = -1;
  w.begun = w.filled = w.started = 0;
  w.s = w.presence = 0.0f;
  return w;
}

// The part of a walk that covers [from, until] of s.
static inline Presence presence_within(const Scene* scene, const Medium* medium, const MediumRay* ray, float from,
                                       float until) {
  Presence w = presence_begin(scene, medium, ray);
  w.begun = 1;
  w.last = presence_border_after(&w, until);
  w.next = min(presence_border_before(&w, from), w.last);
  w.stop = min(w.next + 1, w.last);
  w.dda = dda_begin(medium, ray, from);
  w.dda.end = until;
  return w;
}

// Finds the next borders to look up: those about a brick whose presence changes; 0 at the end.
static inline int presence_next_brick(const Scene* scene, const Medium* medium, Presence* w) {
  while (dda_next_brick(scene, medium, &w->dda)) {
    const float2 range = vload2(w->dda.number, scene->ranges);
    const float enter = w->dda.s, leave = w->dda.brick_end;
    const int changes = range.x < range.y;
    w->dda.s = leave;
    if (range.y < w->outside) continue;
    w->filled = !changes;
    if (w->begun && !changes) continue;
    w->next = max(w->next, presence_border_before(w, enter));
    w->stop = changes ? presence_border_after(w, leave) : w->next;
    w->begun = 1;
    if (w->next <= w->stop) return 1;
  }
  if (!w->filled || w->next > w->last) return 0;
  w->filled = 0;
  w->next = w->stop = w->last;
  return 1;
}

// Presence at W places along the ray, in their order.
static inline floatW presence_at(const Scene* scene, const Medium* medium, const MediumRay* ray, floatW s) {
  const intW x = lanes_brick(s, ray->origin.x, ray->dir.x, medium->brick_nx);
  const intW y = lanes_brick(s, ray->origin.y, ray->dir.y, medium->brick_ny);
  const intW z = lanes_brick(s, ray->origin.z, ray->dir.z, medium->brick_nz);
  const intW found = brick_entries_along(scene, medium, x, y, z);
  const intW used = found != (intW)(BRICK_EMPTY);
  const intW entry = lanes_select((intW)(0), found, used);
  const Lookup l = lookup_from(ray, s, lanes_to_float(x * BRICK_CELLS), lanes_to_float(y * BRICK_CELLS),
                               lanes_to_float(z * BRICK_CELLS), entry * BRICK_VALUES, WITHIN_BRICK);
  return lanes_select((floatW)(0.0f), brick_density(scene, entry, lookup_blend(scene->voxels, &l)), used);
}

// Steps by the borders at which they end.
typedef struct {
  int count;             // of lanes; the others have no length
  floatW begin, size;    // s
  floatW before, after;  // presence where a step begins and ends
  floatW number;         // of the border where it ends
} PresenceSteps;

// The next up to W steps; 0 at the end. The first border of a walk ends a step without length.
static inline int presence_next(const Scene* scene, const Medium* medium, const MediumRay* ray, Presence* w,
                                PresenceSteps* out) {
  floatW number = (floatW)(0.0f);
  int n = 0;
  while (n < W && (w->next <= w->stop || presence_next_brick(scene, medium, w))) {
    const int count = min(W - n, w->stop + 1 - w->next);
    const floatW run = (floatW)((float)(w->next - n)) + lanes_iota();
    number = lanes_select(number, fmin_ordered(run, (floatW)((float)(w->next + count - 1))),
                          lanes_iota() >= (floatW)((float)n));
    w->next += count;
    n += count;
  }
  out->count = n;
  out->number = number;
  if (n == 0) return 0;
  const floatW end = presence_border(w, number);
  out->after = presence_at(scene, medium, ray, end);
  out->begin = lanes_shift(w->started ? w->s : lanes_first(end), end);
  out->before = lanes_shift(w->started ? w->presence : lanes_first(out->after), out->after);
  out->size = end - out->begin;
  w->s = lanes_last(end);
  w->presence = lanes_last(out->after);
  w->started = 1;
  return 1;
}

// Mean over a step of a presence that goes evenly from `a` to `b` and counts as 0 below `outside`.
static inline floatW presence_mean(floatW a, floatW b, floatW outside) {
  const floatW above_a = fmax_ordered(a, outside), above_b = fmax_ordered(b, outside);
  const floatW mean = 0.5f * (above_a + above_b);
  const floatW part = mean * ((above_b - above_a) / (b - a));
  const intW in_a = a >= outside, in_b = b >= outside;
  return lanes_select(lanes_select((floatW)(0.0f), part, in_a | in_b), mean, in_a & in_b);
}

static inline floatW presence_integral(const Presence* w, const PresenceSteps* at) {
  return at->size * presence_mean(at->before, at->after, (floatW)(w->outside));
}

// As segments, which carry their ∫ρ.
static inline void presence_fill(const Scene* scene, const Medium* medium, const MediumRay* ray, Presence* w,
                                 Segments* out) {
  PresenceSteps at;
  out->count = 0;
  do {
    if (!presence_next(scene, medium, ray, w, &at)) return;
  } while (!lanes_any(at.size > (floatW)(0.0f)));
  out->count = at.count;
  lanes_store(at.begin, out->begin);
  lanes_store(mad_exact((floatW)(0.5f), at.size, at.begin), out->place);
  lanes_store(at.size, out->size);
  lanes_store(presence_integral(w, &at), out->integral);
  for (int i = 0; i < W; ++i) {
    out->base[i] = 0;
    out->x[i] = out->y[i] = out->z[i] = 0.0f;
#if BRUME_STORAGE == 2
    out->zero[i] = out->part[i] = 0.0f;
#endif
#if BRUME_RANDOM
    out->id[i] = (uint)out->count;
#endif
#if BRUME_TRACKING
    out->low[i] = out->control[i] = 0.0f;
#endif
  }
}

#endif

static inline floatW linear_integral(const Medium* medium, __global const Voxel* voxels, const MediumRay* ray,
                                     const Segments* at) {
  (void)medium;
  (void)voxels;
  (void)ray;
#if BRUME_LIQUID
  return lanes_load(at->integral);
#else
  return lanes_load(at->size);  // of no use
#endif
}

#endif
