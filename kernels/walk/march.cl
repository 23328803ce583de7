// The marchers and trackers: one sample of either interpolation in each segment, wherever in its brick.
#ifndef BRUME_WALK_MARCH_CL
#define BRUME_WALK_MARCH_CL
#include "walk/steps.cl"

static inline floatW march_integral(const Medium* medium, __global const Voxel* voxels, const MediumRay* ray,
                                    const Segments* at) {
  const Lookup l = lookup_at(ray, at, lanes_load(at->place), WITHIN_BRICK);
  const floatW density = density_of(at, lookup_value(medium, voxels, &l)), size = lanes_load(at->size);
  return lanes_select((floatW)(0.0f), density * size, size > 0.0f);
}

#endif
