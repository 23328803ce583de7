// dda_midpoint: one trilinear sample in the middle of each cell's chord.
#ifndef BRUME_TRANSMITTANCE_DDA_MIDPOINT_CL
#define BRUME_TRANSMITTANCE_DDA_MIDPOINT_CL
#include "transmittance/cells.cl"

static inline floatW dda_midpoint_integral(const Medium* medium, __global const voxel_t* voxels, const MediumRay* ray,
                                           const Segments* at) {
  (void)medium;
  return density_trilinear(voxels, ray, at, lanes_load(at->place), REACH_CELL) * lanes_load(at->size);
}

#endif
