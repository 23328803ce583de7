// march_midpoint: equal steps, one sample of either interpolation in the middle of each.
#ifndef BRUME_TRANSMITTANCE_MARCH_MIDPOINT_CL
#define BRUME_TRANSMITTANCE_MARCH_MIDPOINT_CL
#include "transmittance/steps.cl"

static inline floatW march_midpoint_integral(const Medium* medium, __global const float* voxels, const MediumRay* ray,
                                             const Segments* at) {
  const floatW middle = lanes_load(at->middle);
  const floatW density = medium->interpolation == INTERPOLATION_NEAREST
                             ? density_nearest(voxels, ray, at, middle, REACH_BRICK)
                             : density_trilinear(voxels, ray, at, middle, REACH_BRICK);
  return density * lanes_load(at->size);
}

#endif
