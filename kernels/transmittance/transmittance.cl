// The dispatcher over methods: an iterator of segments with ∫ρ over each, and the optical depth of a whole ray.
#ifndef BRUME_TRANSMITTANCE_TRANSMITTANCE_CL
#define BRUME_TRANSMITTANCE_TRANSMITTANCE_CL
#include "transmittance/dda_gauss2.cl"
#include "transmittance/dda_midpoint.cl"
#include "transmittance/dda_nearest.cl"
#include "transmittance/homogeneous.cl"
#include "transmittance/march.cl"
#include "transmittance/tracking.cl"

// True for the method of this medium; folds to a constant when the scene uses one method only.
#define METHOD_IS(medium, id) \
  (USES_METHOD(id) && ((BRUME_METHODS_USED) == (1 << METHOD_##id) || (medium)->method == METHOD_##id))

#define METHOD_MARCHES(medium)                                              \
  (METHOD_IS(medium, MARCH_MIDPOINT) || METHOD_IS(medium, MARCH_REGULAR) || \
   METHOD_IS(medium, MARCH_MIDPOINT_JITTER) || METHOD_IS(medium, MARCH_REGULAR_JITTER))

#if BRUME_TRACKING
#define METHOD_TRACKS(medium) \
  (METHOD_IS(medium, DELTA_TRACKING) || METHOD_IS(medium, RATIO_TRACKING) || METHOD_IS(medium, RESIDUAL_RATIO))
#else
#define METHOD_TRACKS(medium) 0
#endif

typedef struct {
  Dda dda;
  Steps steps;
#if BRUME_TRACKING
  Track track;
#endif
} Walk;

static inline Steps walk_steps(const Medium* medium, const MediumRay* ray, Random random) {
  if (METHOD_IS(medium, MARCH_REGULAR)) return steps_begin(medium, ray, random, 0.0f, 0.0f);
  if (METHOD_IS(medium, MARCH_REGULAR_JITTER)) return steps_begin(medium, ray, random, 0.0f, 1.0f);
  if (METHOD_IS(medium, MARCH_MIDPOINT_JITTER)) return steps_begin(medium, ray, random, 0.25f, 0.5f);
  return steps_begin(medium, ray, random, 0.5f, 0.0f);
}

// only_tau: nobody asks for light along the way.
static inline Walk walk_begin(const Medium* medium, const MediumRay* ray, Random random, int only_tau) {
  Walk w;
  if (!METHOD_MARCHES(medium)) w.dda = dda_begin(medium, ray, 0.0f);
  w.steps = walk_steps(medium, ray, random);
#if BRUME_TRACKING
  w.track = track_begin(medium, random, METHOD_IS(medium, RESIDUAL_RATIO), only_tau);
#endif
  return w;
}

// The next up to W segments in order along the ray; count 0 at the end.
static inline void walk_next(const Scene* scene, const Medium* medium, const MediumRay* ray, Walk* w, Segments* out) {
  if (METHOD_IS(medium, HOMOGENEOUS)) {
    homogeneous_fill(&w->steps, out);
  } else if (METHOD_MARCHES(medium)) {
    steps_fill(scene, medium, ray, &w->steps, out);
#if BRUME_TRACKING
  } else if (METHOD_TRACKS(medium)) {
    track_fill(scene, medium, &w->dda, &w->track, out);
#endif
  } else {
    cells_fill(scene, medium, ray, &w->dda, out);
  }
}

// ∫ρ over each of the segments, in world length.
static inline floatW walk_integral(const Scene* scene, const Medium* medium, const MediumRay* ray, const Segments* at) {
  if (METHOD_IS(medium, HOMOGENEOUS)) return homogeneous_integral(medium, at);
  if (METHOD_MARCHES(medium) || METHOD_TRACKS(medium)) return march_integral(medium, scene->voxels, ray, at);
  if (METHOD_IS(medium, DDA_NEAREST)) return dda_nearest_integral(scene->voxels, ray, at);
  if (METHOD_IS(medium, DDA_MIDPOINT)) return dda_midpoint_integral(scene->voxels, ray, at);
  return dda_gauss2_integral(scene->voxels, ray, at);
}

static inline uint walk_lookups(const Medium* medium, const Segments* at) {
  if (METHOD_IS(medium, HOMOGENEOUS)) return 0;
  return (uint)at->count * (METHOD_IS(medium, DDA_GAUSS2) ? 2 : 1);
}

#if BRUME_RANDOM
// What names the random numbers of segment i.
static inline uint walk_id(const Medium* medium, const Segments* at, int i) {
  if (METHOD_IS(medium, HOMOGENEOUS) || METHOD_MARCHES(medium) || METHOD_TRACKS(medium)) return at->id[i];
  return ((uint)(int)at->x[i] * 0x8DA6B343u) ^ ((uint)(int)at->y[i] * 0xD8163841u) ^
         ((uint)(int)at->z[i] * 0xCB1AB31Fu);
}
#else
#define walk_id(medium, at, i) 0
#endif

// ∫ρ over the whole stretch, not for trackers; the rest is left out once it is black by an extinction of `sigma`.
static inline float walk_total(const Scene* scene, const Medium* medium, const MediumRay* ray, Random random,
                               float sigma, uint* lookups) {
  if (!(ray->length > 0.0f)) return 0.0f;
  if (METHOD_IS(medium, HOMOGENEOUS)) return homogeneous_total(medium, ray);
  Walk walk = walk_begin(medium, ray, random, 1);
  Segments at;
  float total = 0.0f;
  for (walk_next(scene, medium, ray, &walk, &at); at.count > 0 && total * sigma < TAU_STOP;
       walk_next(scene, medium, ray, &walk, &at)) {
    total += lanes_sum(walk_integral(scene, medium, ray, &at));
    *lookups += walk_lookups(medium, &at);
  }
  return total;
}

#endif
