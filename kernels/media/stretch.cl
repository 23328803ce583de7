// A batch of segments along a view ray through one medium, what the other media do along them, and how dense ones are
// cut.
#ifndef BRUME_MEDIA_STRETCH_CL
#define BRUME_MEDIA_STRETCH_CL
#include "lights/lights.cl"
#include "media/others.cl"

// Collisions estimate exp(-τ) without bias, but nothing else of τ: scenes with trackers take light and the other media
// at the place of each segment.
#define TAKES_ENDS(scene) (!BRUME_TRACKING || (scene)->frame->takes_ends)

// A segment of more than TAU_THIN takes the light from both its ends; one of more than TAU_PART is cut into equal
// parts. The slack keeps depths that are a whole number of parts by construction from falling to either side by
// rounding.
#define TAU_THIN (1.0f / 16.0f)
#define TAU_THIN_CONSTANT (1.0f / 512.0f)  // of a constant medium, through which a depth is one product
#define TAU_PART (1.0f / 8.0f)
#define TAU_PART_GAUSS2 (1.0f / 4.0f)    // of more with light at two points of each
#define TAU_PART_GLOW (1.0f / 64.0f)     // of others beside what only glows: they need not grow as it does
#define GLOW_PARTS_MAX 8.0f              // of many media, that many more would cost their number squared
#define TAU_ENDS_GAUSS2 (1.0f / 2.0f)    // parts that are denser still have the points at their ends
#define TAU_ENDS_ADAPTIVE (3.0f / 2.0f)  // the same of `adaptive`, whose parts may be up to 1
#define PARTS_SLACK 0x1p-10f
// Ends are taken this share of the segment further in: on a face of a medium, light along that face would be in or out
// by rounding.
#define END_INSET 0x1p-14f
#define PARTS_MAX 256.0f

// A segment with light at two points is no longer than this share of its distance to a lamp.
#define LIGHT_PART 0.25f

#define LIGHTS_ALL(scene) ((scene)->frame->light_picks == (scene)->frame->light_count)

// The rule by which the frame sums light; folds to a constant when kernels are made for it alone.
#define IN_SCATTERING_IS(scene, id)                             \
  ((((BRUME_IN_SCATTERINGS_USED) >> IN_SCATTERING_##id) & 1) && \
   ((BRUME_IN_SCATTERINGS_USED) == (1 << IN_SCATTERING_##id) || (scene)->frame->in_scattering == IN_SCATTERING_##id))

// The same of one medium: `adaptive` has two points in each segment, whatever the frame says.
#define SUMS_BY(scene, medium, id) \
  (METHOD_IS(medium, ADAPTIVE) ? IN_SCATTERING_##id == IN_SCATTERING_GAUSS2 : IN_SCATTERING_IS(scene, id))

// τ of the media beside one, carried along a view ray.
typedef struct {
  float s;  // up to where it is known, from where the ray enters the medium that is walked
  Tau tau;
} Others;

struct Kinks;
struct Ladder;

// A stretch: one batch of segments of a view ray, and what is known of each.
typedef struct {
  const Medium* medium;
  const MediumRay* ray;
  const Segments* at;
  const struct Kinks* kinks;  // along the whole ray; 0: segments are not cut at them
  float3 origin, dir;         // world
  float t_max;
  Random random;      // of the ray,
  Random walk;        // of the walk through this medium
  float integral[W];  // ∫ρ over each segment; 0 where no light is asked for
#if BRUME_RANDOM
  uint id[W];  // names the random numbers of each
#endif
#if BRUME_MEDIA >= 2
  floatW others[TAU_CHANNELS];  // τ of the other media up to where each begins,
  floatW beside[TAU_CHANNELS];  // and over it
#endif
#if BRUME_MEDIA >= 3
  struct Ladder* ladder;  // 0: each segment asks for its own depths to the light
  int on_ladder[W];       // else those that do not
#endif
  floatW gain[TAU_CHANNELS];   // ∫ρT over each segment: what each unit of σs S + emission in it sends to the origin
  floatW depth[TAU_CHANNELS];  // τ of all media over each
  intW dense;                  // takes the light from both ends
  floatW second;               // share of ∫ρ about the second of two points
  float light_t;               // world distance of the last point whose depth to the only light was asked for,
  Tau light_tau;               // and that depth
} Stretch;

#if BRUME_RANDOM
#define stretch_id(s, i) ((s)->id[i])
#define stretch_random(s, i, stream) random_stream(random_stream((s)->walk, (s)->id[i]), stream)
#else
#define stretch_id(s, i) 0
#define stretch_random(s, i, stream) ((s)->walk)
#endif

static inline float stretch_begin(const Stretch* s, int i) { return s->ray->t_begin + s->at->begin[i]; }
static inline float stretch_end(const Stretch* s, int i) {
  return s->ray->t_begin + (s->at->begin[i] + s->at->size[i]);
}

#if BRUME_MEDIA >= 2
#if BRUME_TRACKING
// τ of the media beside m up to s.
static inline void others_advance(const Scene* scene, const Stretch* stretch, int m, float s, Random random,
                                  Others* others, uint* lookups) {
  const float size = s - others->s;
  if (!(size > 0.0f)) return;
  const float3 origin = vec_point(stretch->origin, stretch->dir, stretch->ray->t_begin + others->s);
  others->tau += media_tau(scene, m, origin, stretch->dir, size, random, lookups);
  others->s = s;
}

// Up to the place of each segment, one by one: where a medium is tracked, each answer is an estimate of its own.
static inline void stretch_others_placed(const Scene* scene, Stretch* s, int m, Others* others, uint* lookups) {
  float before[TAU_CHANNELS][W];
  for (int i = 0; i < W; ++i) {
    if (s->integral[i] > 0.0f)
      others_advance(scene, s, m, s->at->place[i], stretch_random(s, i, STREAM_OTHERS), others, lookups);
    for (int c = 0; c < TAU_CHANNELS; ++c) before[c][i] = tau_channel(others->tau, c);
  }
  for (int c = 0; c < TAU_CHANNELS; ++c) s->others[c] = lanes_load(before[c]);
}
#endif

// Adds what medium m brings to others, beside and, from the last segment that counts, to *tau.
static inline void stretch_other(const Scene* scene, Stretch* s, int m, float from, int last, Tau* tau, uint* lookups) {
  const Medium medium = scene->media[m];
  const Tau sigma_t = medium_sigma_t(&medium);
  if (!(tau_max(sigma_t) > 0.0f)) return;
  const MediumRay ray = medium_ray(&medium, s->origin, s->dir, s->t_max);
  const floatW begin = lanes_load(s->at->begin), end = begin + lanes_load(s->at->size);
  const Beside beside = beside_of(scene, &medium, &ray, random_stream(s->random, (uint)m), s->ray->t_begin, from,
                                  s->at->begin[last] + s->at->size[last], begin, end, lookups);
  float until[W];
  lanes_store(beside.before + beside.along, until);
  *tau += sigma_t * until[last];
  for (int c = 0; c < TAU_CHANNELS; ++c) {
    s->others[c] += tau_channel(sigma_t, c) * beside.before;
    s->beside[c] += tau_channel(sigma_t, c) * beside.along;
  }
}

// Of all media but those from `first` to before `end` up to and over each segment that counts.
static inline void stretch_others(const Scene* scene, Stretch* s, int first, int end, Others* others, uint* lookups) {
  int last = -1;
  for (int i = 0; i < W; ++i) last = s->integral[i] > 0.0f ? i : last;
  for (int c = 0; c < TAU_CHANNELS; ++c) {
    s->others[c] = (floatW)(tau_channel(others->tau, c));
    s->beside[c] = (floatW)(0.0f);
  }
  if (last < 0) return;
#if BRUME_TRACKING
  if (!TAKES_ENDS(scene)) {
    stretch_others_placed(scene, s, first, others, lookups);
    return;
  }
#endif
  for (int other = 0; other < MEDIA_END(scene); ++other)
    if (other < first || other >= end) stretch_other(scene, s, other, others->s, last, &others->tau, lookups);
  others->s = s->at->begin[last] + s->at->size[last];
  const intW counts = lanes_load(s->integral) > (floatW)(0.0f);
  for (int c = 0; c < TAU_CHANNELS; ++c) s->beside[c] = lanes_select((floatW)(0.0f), s->beside[c], counts);
}
#endif

// Depth of all media over each segment.
static inline void stretch_depths(Stretch* s, Tau sigma_t) {
  const floatW integral = lanes_load(s->integral);
  for (int c = 0; c < TAU_CHANNELS; ++c) {
    s->depth[c] = tau_channel(sigma_t, c) * integral;
#if BRUME_MEDIA >= 2
    s->depth[c] += s->beside[c];
#endif
  }
}

static inline floatW stretch_depth_max(const Stretch* s) {
  floatW depth = s->depth[0];
  for (int c = 1; c < TAU_CHANNELS; ++c) depth = lanes_select(depth, s->depth[c], s->depth[c] > depth);
  return depth;
}

// Too deep for two points within each.
static inline intW stretch_deep(const Stretch* s) {
  return stretch_depth_max(s) > (floatW)(METHOD_IS(s->medium, ADAPTIVE) ? TAU_ENDS_ADAPTIVE : TAU_ENDS_GAUSS2);
}

// The parts of a batch of segments that are still to come.
typedef struct {
  float count[W];  // of each segment
  float share[W];  // ∫ρ over one part, where the density of a segment is constant
  int lane;        // of the next part; W when there is none
  int part;
} Cut;

// How many parts of each segment the lamps near it ask for.
static inline floatW stretch_light_parts(const Scene* scene, const Stretch* s) {
  const floatW begin = lanes_load(s->at->begin), size = lanes_load(s->at->size);
  const float3 origin = vec_point(s->origin, s->dir, s->ray->t_begin);
  floatW parts = (floatW)(0.0f);
  for (int l = 0; l < scene->frame->light_count; ++l) {
    const Light light = scene->lights[l];
    if (LIGHT_IS(&light, DIRECTIONAL) || light.exponent != 0) continue;
    const float3 to = vec_unpack(light.position) - origin;
    const float along = dot(to, s->dir);
    const float3 beside = to - along * s->dir;
    const floatW ahead = fmax(fmax(begin - along, along - (begin + size)), (floatW)(0.0f));
    parts =
        fmax(parts, size * (1.0f / LIGHT_PART) / sqrt(mad_exact(ahead, ahead, (floatW)(dot(beside, beside) + 1e-30f))));
  }
  return parts;
}

static inline int medium_only_glows(const Medium* medium) {
  return !(vec_max(vec_unpack(medium->sigma_s)) > 0.0f) && vec_max(vec_unpack(medium->emission)) > 0.0f;
}

// How many parts of each segment the depth of the others over it asks for: glow costs no rays of light.
static inline floatW stretch_glow_parts(const Stretch* s) {
  floatW parts = (floatW)(0.0f);
#if BRUME_MEDIA >= 2
  for (int c = 0; c < TAU_CHANNELS; ++c) parts = fmax(parts, s->beside[c] * (1.0f / TAU_PART_GLOW));
#endif
  return fmin(parts, (floatW)(GLOW_PARTS_MAX));
}

// Cuts the segments if one of them is too dense, or too long beside a lamp; 0 if none is.
static inline int stretch_cut(const Scene* scene, const Stretch* s, Cut* cut) {
  float each = SUMS_BY(scene, s->medium, GAUSS2) ? 1.0f / TAU_PART_GAUSS2 : 1.0f / TAU_PART;
  if (METHOD_IS(s->medium, ADAPTIVE)) each = 1.0f / s->medium->tau_part;
  floatW parts = stretch_depth_max(s) * each;
  if (SUMS_BY(scene, s->medium, GAUSS2) && LIGHTS_ALL(scene) && !IS_PRODUCT(s->medium) &&
      vec_max(vec_unpack(s->medium->sigma_s)) > 0.0f)
    parts = fmax(parts, stretch_light_parts(scene, s));
  if (SUMS_BY(scene, s->medium, GAUSS2) && !METHOD_IS(s->medium, ADAPTIVE) && medium_only_glows(s->medium))
    parts = fmax(parts, stretch_glow_parts(s));
  parts -= PARTS_SLACK;
  if (!lanes_any(parts > (floatW)(1.0f))) return 0;
  const floatW count = fmin(fmax(ceil(parts), (floatW)(1.0f)), (floatW)(PARTS_MAX));
  lanes_store(count, cut->count);
  lanes_store(lanes_load(s->integral) / count, cut->share);
  cut->lane = 0;
  cut->part = 0;
  return 1;
}

// The next up to W parts of `whole` as segments of their own, at the same share of each.
static inline void stretch_parts(const Segments* whole, Cut* cut, Segments* out, Stretch* s) {
  int n = 0;
  for (int i = 0; i < W; ++i) s->integral[i] = 0.0f;
  while (n < W && cut->lane < W) {
    const int i = cut->lane;
    const float count = cut->count[i], size = whole->size[i] / count;
    if (!(cut->share[i] > 0.0f) || !((float)cut->part < count)) {
      ++cut->lane;
      cut->part = 0;
      continue;
    }
    out->begin[n] = mad_exact((float)cut->part, size, whole->begin[i]);
    out->place[n] = out->begin[n] + (whole->place[i] - whole->begin[i]) / count;
    out->size[n] = size;
    out->base[n] = whole->base[i];
    out->x[n] = whole->x[i];
    out->y[n] = whole->y[i];
    out->z[n] = whole->z[i];
#if BRUME_STORAGE == 2
    out->zero[n] = whole->zero[i];
    out->part[n] = whole->part[i];
#endif
#if BRUME_RANDOM
    out->id[n] = walk_id(s->medium, whole, i) + (uint)cut->part * 0x9E3779B1u;
#endif
    s->integral[n++] = cut->share[i];
    ++cut->part;
  }
  out->count = n;
  segments_pad(out);
}

#endif
