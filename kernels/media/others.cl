// Depth of the media beside one along a view ray: each is walked once over the length of a whole batch of segments,
// and how far its segments have come where those of the batch begin and end follows from how ∫ρ grows inside of each.
#ifndef BRUME_MEDIA_OTHERS_CL
#define BRUME_MEDIA_OTHERS_CL
#include "media/tau.cl"

#if BRUME_MEDIA >= 2

// The share of ∫ρ in each of W segments up to u of its length, times ∫ρ: u (c[0] + u (c[1] + u (c[2] + u c[3]))).
typedef struct {
  float begin[W], end[W], inv_size[W];  // s; the last 0 for a lane without length
  float c[4][W];
} Growth;

#define GROWS_AS_CUBIC ((RULES_USED >> RULE_GAUSS2) & 1)

// Exact for dda_gauss2 and where a density is constant; evenly for the other rules, which know no more of a segment.
static inline Growth growth_of(const Scene* scene, const Medium* medium, const MediumRay* ray, const Segments* at) {
  Growth g;
  const floatW size = lanes_load(at->size);
  floatW c[4] = {(floatW)(0.0f), (floatW)(0.0f), (floatW)(0.0f), (floatW)(0.0f)};
  if (RULE_IS(medium, GAUSS2))
    dda_gauss2_growth(scene->voxels, ray, at, c);
  else
    c[0] = walk_integral(scene, medium, ray, at);
  lanes_store(lanes_load(at->begin), g.begin);
  lanes_store(lanes_load(at->begin) + size, g.end);
  lanes_store(lanes_select((floatW)(0.0f), 1.0f / size, size > 0.0f), g.inv_size);
  for (int k = 0; k < 4; ++k) lanes_store(c[k], g.c[k]);
  return g;
}

static inline floatW growth_at(const Growth* g, int i, floatW s) {
  const floatW u = fmin(fmax((s - g->begin[i]) * g->inv_size[i], (floatW)(0.0f)), (floatW)(1.0f));
  if (!GROWS_AS_CUBIC) return u * g->c[0][i];
  floatW v = mad_exact(u, (floatW)(g->c[3][i]), (floatW)(g->c[2][i]));
  v = mad_exact(u, v, (floatW)(g->c[1][i]));
  return u * mad_exact(u, v, (floatW)(g->c[0][i]));
}

static inline float growth_whole(const Growth* g, int i) {
  return GROWS_AS_CUBIC ? g->c[0][i] + (g->c[1][i] + g->c[2][i] + g->c[3][i]) : g->c[0][i];
}

// ∫ρ over each of the segments.
static inline floatW growth_integral(const Growth* g) {
  floatW sum = lanes_load(g->c[0]);
  if (GROWS_AS_CUBIC) sum += (lanes_load(g->c[1]) + lanes_load(g->c[2])) + lanes_load(g->c[3]);
  return sum;
}

// ∫ρ of a medium beside W segments.
typedef struct {
  floatW before;  // from where the stretch begins to where each of them does
  floatW along;   // over each
} Beside;

static inline Beside beside_constant(const Medium* medium, float from, float until, floatW begin, floatW end) {
  const floatW first = fmin(fmax(begin, (floatW)(from)), (floatW)(until));
  const floatW last = fmin(fmax(end, (floatW)(from)), (floatW)(until));
  const Beside out = {medium->constant_density * (first - from), medium->constant_density * (last - first)};
  return out;
}

// Of a medium over [from, until] of its own s, in which the segments begin and end; what is behind is left out.
OUTLINED Beside beside_walk(const Scene* scene, const Medium* medium, const MediumRay* ray, Random random, float from,
                            float until, floatW begin, floatW end, uint* lookups) {
  const int whole = WALKED_IS(medium, STEPS) || WALKED_IS(medium, PIECES) ||
                    RULE_IS(medium, MIDPOINT);  // segments may begin before `from`
  Beside out = {(floatW)(0.0f), (floatW)(0.0f)};
  Walk walk = walk_within(scene, medium, ray, random, from, until);
  Segments at;
  for (;;) {
    walk_next_stored(scene, medium, ray, &walk, &at);
    if (at.count == 0) return out;
    if (RULE_IS(medium, MIDPOINT)) cells_whole(ray, &at);
    const Growth growth = growth_of(scene, medium, ray, &at);
    *lookups += (uint)at.count;
    __attribute__((opencl_unroll_hint(1)))  // unrolled it would take as long to compile as the walk
    for (int i = 0; i < W; ++i) {
      if (!(growth.inv_size[i] > 0.0f)) continue;
      const floatW first = growth_at(&growth, i, begin);
      out.before += first;
      if (whole && growth.begin[i] < from) out.before -= growth_at(&growth, i, (floatW)(from));
      out.along += growth_at(&growth, i, end) - first;
    }
  }
}

// Of any medium. `from`, `until`, begin and end are measured from world distance `t_begin`.
static inline Beside beside_of(const Scene* scene, const Medium* medium, const MediumRay* ray, Random random,
                               float t_begin, float from, float until, floatW begin, floatW end, uint* lookups) {
  const float shift = t_begin - ray->t_begin;  // 0 for media on one spot, however far the eye
  const float first = fmax(from + shift, 0.0f), last = fmin(until + shift, ray->length);
  Beside none = {(floatW)(0.0f), (floatW)(0.0f)};
  if (!(last > first)) return none;
  if (IS_PRODUCT(medium)) return beside_constant(medium, first, last, begin + shift, end + shift);
  return beside_walk(scene, medium, ray, random, first, last, begin + shift, end + shift, lookups);
}

#endif
#endif
