// The dispatcher over methods: an iterator of segments with ∫ρ over each, and the optical depth of a whole ray.
#ifndef BRUME_TRANSMITTANCE_TRANSMITTANCE_CL
#define BRUME_TRANSMITTANCE_TRANSMITTANCE_CL
#include "transmittance/dda_gauss2.cl"
#include "transmittance/dda_midpoint.cl"
#include "transmittance/dda_nearest.cl"
#include "transmittance/homogeneous.cl"
#include "transmittance/march.cl"

// True for the method of this medium; folds to a constant when the scene uses one method only.
#define METHOD_IS(medium, id) \
  (USES_METHOD(id) && ((BRUME_METHODS_USED) == (1 << METHOD_##id) || (medium)->method == METHOD_##id))

#define METHOD_MARCHES(medium) (METHOD_IS(medium, MARCH_MIDPOINT) || METHOD_IS(medium, MARCH_REGULAR))

typedef struct {
  Dda dda;
  Steps steps;
} Walk;

static inline Walk walk_begin(const Medium* medium, const MediumRay* ray) {
  Walk w;
  w.dda = dda_begin(medium, ray);
  w.steps = steps_begin(medium, ray, METHOD_IS(medium, MARCH_REGULAR) ? 0.0f : 0.5f);
  return w;
}

// The next up to W segments in order along the ray; count 0 at the end.
static inline void walk_next(const Scene* scene, const Medium* medium, const MediumRay* ray, Walk* w, Segments* out) {
  if (METHOD_IS(medium, HOMOGENEOUS)) {
    homogeneous_fill(&w->steps, out);
  } else if (METHOD_MARCHES(medium)) {
    steps_fill(medium, scene->bricks, &w->dda, &w->steps, out);
  } else {
    cells_fill(medium, scene->bricks, ray, &w->dda, out);
  }
  segments_pad(out);
}

// ∫ρ over each of the segments, in world length.
static inline floatW walk_integral(const Scene* scene, const Medium* medium, const MediumRay* ray, const Segments* at) {
  if (METHOD_IS(medium, HOMOGENEOUS)) return homogeneous_integral(medium, at);
  if (METHOD_MARCHES(medium)) return march_integral(medium, scene->voxels, ray, at);
  if (METHOD_IS(medium, DDA_NEAREST)) return dda_nearest_integral(scene->voxels, ray, at);
  if (METHOD_IS(medium, DDA_MIDPOINT)) return dda_midpoint_integral(scene->voxels, ray, at);
  return dda_gauss2_integral(scene->voxels, ray, at);
}

static inline uint walk_lookups(const Medium* medium, const Segments* at) {
  if (METHOD_IS(medium, HOMOGENEOUS)) return 0;
  return (uint)at->count * (METHOD_IS(medium, DDA_GAUSS2) ? 2 : 1);
}

// ∫ρ over the whole stretch; the rest is left out once it exceeds `stop`.
static inline float walk_total(const Scene* scene, const Medium* medium, const MediumRay* ray, float stop,
                               uint* lookups) {
  if (!(ray->length > 0.0f)) return 0.0f;
  if (METHOD_IS(medium, HOMOGENEOUS)) return homogeneous_total(medium, ray);
  Walk walk = walk_begin(medium, ray);
  Segments at;
  float total = 0.0f;
  for (walk_next(scene, medium, ray, &walk, &at); at.count > 0 && total < stop;
       walk_next(scene, medium, ray, &walk, &at)) {
    total += lanes_sum(walk_integral(scene, medium, ray, &at));
    *lookups += walk_lookups(medium, &at);
  }
  return total;
}

#endif
