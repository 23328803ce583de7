// The dispatcher over methods: an iterator of segments with ∫ρ over each, and the optical depth of a whole ray.
#ifndef BRUME_WALK_WALK_CL
#define BRUME_WALK_WALK_CL
#include "walk/dda_gauss2.cl"
#include "walk/dda_midpoint.cl"
#include "walk/dda_nearest.cl"
#include "walk/homogeneous.cl"
#include "walk/march.cl"
#include "walk/pieces.cl"
#include "walk/presence.cl"
#include "walk/tracking.cl"

// True for the method, placement or rule of this medium; folds to a constant when the scene uses one only, and code for
// those that it does not use falls away.
#define METHOD_IS(medium, id) \
  (USES_METHOD(id) && ((BRUME_METHODS_USED) == (1 << METHOD_##id) || (medium)->method == METHOD_##id))
#define PLACEMENT_IS(medium, id)                \
  (((PLACEMENTS_USED >> PLACEMENT_##id) & 1) && \
   (PLACEMENTS_USED == (1 << PLACEMENT_##id) || method_placement((medium)->method) == PLACEMENT_##id))
#define RULE_IS(medium, id) \
  (((RULES_USED >> RULE_##id) & 1) && (RULES_USED == (1 << RULE_##id) || method_rule((medium)->method) == RULE_##id))

// A density without voxels, whose integral is a product.
#define IS_PRODUCT(medium) (RULE_IS(medium, PRODUCT) || (METHOD_IS(medium, ADAPTIVE) && (medium)->is_constant))

#define WALKED_IS(medium, id)                     \
  (((PLACEMENTS_WALKED >> PLACEMENT_##id) & 1) && \
   (PLACEMENTS_WALKED == (1 << PLACEMENT_##id) || method_placement((medium)->method) == PLACEMENT_##id))

typedef struct {
  Dda dda;
  Steps steps;
  Pieces pieces;
#if BRUME_LIQUID
  Presence presence;
#endif
#if BRUME_TRACKING
  Track track;
#endif
} Walk;

// What a walk is for.
#define WALK_SCATTERS 0  // light is asked for along the way
#define WALK_SEEN 1      // only the depth is, of a view ray
#define WALK_TO_LIGHT 2  // or of a ray to a light

static inline Walk walk_begin(const Scene* scene, const Medium* medium, const MediumRay* ray, Random random,
                              int purpose) {
  Walk w;
#if BRUME_LIQUID
  if (RULE_IS(medium, LINEAR)) {
    w.presence = presence_begin(scene, medium, ray);
    return w;
  }
#endif
  if (!PLACEMENT_IS(medium, STEPS)) w.dda = dda_begin(medium, ray, 0.0f);
  w.steps = steps_begin(medium, ray, random, method_share(medium->method), method_jitter(medium->method));
  w.pieces = pieces_begin(ray, ray->length, purpose == WALK_TO_LIGHT);
#if BRUME_TRACKING
  w.track = track_begin(medium, random, METHOD_IS(medium, RESIDUAL_RATIO), purpose != WALK_SCATTERS);
#endif
  return w;
}

// The part of a walk that covers [from, until] of s: steps and pieces stay as they are along the whole ray, cells are
// cut.
static inline Walk walk_within(const Scene* scene, const Medium* medium, const MediumRay* ray, Random random,
                               float from, float until) {
  Walk w;
#if BRUME_LIQUID
  if (RULE_IS(medium, LINEAR)) {
    w.presence = presence_within(scene, medium, ray, from, until);
    return w;
  }
#endif
  if (WALKED_IS(medium, STEPS)) {
    w.steps = steps_begin(medium, ray, random, method_share(medium->method), method_jitter(medium->method));
    w.steps.next = min((int)(from / w.steps.size), w.steps.count);
    w.steps.count = min((int)ceil(until / w.steps.size), w.steps.count);
  } else {
    w.dda = dda_begin(medium, ray, from);
    if (WALKED_IS(medium, PIECES)) {
      w.dda.s = dda_brick_enter(&w.dda);
      w.pieces = pieces_begin(ray, until, 0);
    } else {
      w.dda.end = until;
    }
  }
  return w;
}

// The next up to W segments of a medium that is not constant.
static inline void walk_next_stored(const Scene* scene, const Medium* medium, const MediumRay* ray, Walk* w,
                                    Segments* out) {
#if BRUME_LIQUID
  if (RULE_IS(medium, LINEAR)) {
    presence_fill(scene, medium, ray, &w->presence, out);
    return;
  }
#endif
  if (WALKED_IS(medium, STEPS)) {
    steps_fill(scene, medium, ray, &w->steps, out);
  } else if (WALKED_IS(medium, PIECES)) {
    pieces_fill(scene, medium, ray, &w->dda, &w->pieces, out);
#if BRUME_TRACKING
  } else if (WALKED_IS(medium, COLLISIONS)) {
    track_fill(scene, medium, &w->dda, &w->track, out);
#endif
  } else {
    cells_fill(scene, medium, ray, &w->dda, out);
  }
}

// The next up to W segments in order along the ray; count 0 at the end.
static inline void walk_next(const Scene* scene, const Medium* medium, const MediumRay* ray, Walk* w, Segments* out) {
  if (IS_PRODUCT(medium))
    homogeneous_fill(&w->steps, out);
  else
    walk_next_stored(scene, medium, ray, w, out);
}

// ∫ρ over each of the segments, in world length. A rule without its function does not compile.
static inline floatW walk_integral(const Scene* scene, const Medium* medium, const MediumRay* ray, const Segments* at) {
  if (IS_PRODUCT(medium)) return homogeneous_integral(medium, scene->voxels, ray, at);
#define RULE(id, function, lookups) \
  if (RULE_IS(medium, id)) return function##_integral(medium, scene->voxels, ray, at);
  BRUME_RULES(RULE)
#undef RULE
  return (floatW)(0.0f);
}

// The same, and the share of it that lies about the second of two points: even where a rule knows no more.
static inline floatW walk_integral_shares(const Scene* scene, const Medium* medium, const MediumRay* ray,
                                          const Segments* at, floatW* second) {
  if (RULE_IS(medium, GAUSS2)) return dda_gauss2_shares(scene->voxels, ray, at, second);
  if (RULE_IS(medium, PIECE) && !IS_PRODUCT(medium)) return piece_shares(medium, scene->voxels, ray, at, second);
  *second = (floatW)(0.5f);
  return walk_integral(scene, medium, ray, at);
}

static inline uint walk_lookups(const Medium* medium, const Segments* at) {
  if (IS_PRODUCT(medium)) return 0;
#define RULE(id, function, lookups) \
  if (RULE_IS(medium, id)) return (uint)at->count * (lookups);
  BRUME_RULES(RULE)
#undef RULE
  return 0;
}

#if BRUME_RANDOM
// What names the random numbers of segment i.
static inline uint walk_id(const Medium* medium, const Segments* at, int i) {
  if (!PLACEMENT_IS(medium, CELLS)) return at->id[i];
  return ((uint)(int)at->x[i] * 0x8DA6B343u) ^ ((uint)(int)at->y[i] * 0xD8163841u) ^
         ((uint)(int)at->z[i] * 0xCB1AB31Fu);
}
#else
#define walk_id(medium, at, i) 0
#endif

// ∫ρ over the whole ray inside the medium, not for trackers; the rest is left out once it is black by an extinction of
// `sigma`.
static inline float walk_total(const Scene* scene, const Medium* medium, const MediumRay* ray, Random random,
                               int purpose, float sigma, uint* lookups) {
  if (!(ray->length > 0.0f)) return 0.0f;
  if (IS_PRODUCT(medium)) return homogeneous_total(medium, ray);
  Walk walk = walk_begin(scene, medium, ray, random, purpose);
  const int light_steps = METHOD_IS(medium, ADAPTIVE) && purpose == WALK_TO_LIGHT && medium->light_steps;
  if (!RULE_IS(medium, LINEAR) && (WALKED_IS(medium, STEPS) || light_steps))
    return steps_total(scene, medium, ray, &walk.steps, sigma, lookups);
  Segments at;
  float total = 0.0f;
  while (total * sigma < TAU_STOP) {  // one call of walk_next: every call site is compiled anew
    walk_next_stored(scene, medium, ray, &walk, &at);
    if (at.count == 0) break;
    total += lanes_sum(walk_integral(scene, medium, ray, &at));
    *lookups += walk_lookups(medium, &at);
  }
  return total;
}

#endif
