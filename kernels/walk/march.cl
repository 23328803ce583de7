// The marchers and trackers: one sample of either interpolation in each segment, wherever in its brick.
#ifndef BRUME_WALK_MARCH_CL
#define BRUME_WALK_MARCH_CL
#include "walk/steps.cl"

static inline floatW march_integral(const Medium* medium, __global const Voxel* voxels, const MediumRay* ray,
                                    const Segments* at) {
  const floatW place = lanes_load(at->place);
  const floatW density = medium->interpolation == INTERPOLATION_NEAREST
                             ? density_nearest(voxels, ray, at, place, WITHIN_BRICK)
                             : density_trilinear(voxels, ray, at, place, WITHIN_BRICK);
  const floatW size = lanes_load(at->size);
  return lanes_select((floatW)(0.0f), density * size, size > 0.0f);
}

#endif
