// dda_midpoint: one trilinear sample in the middle of each cell's chord.
#ifndef BRUME_WALK_DDA_MIDPOINT_CL
#define BRUME_WALK_DDA_MIDPOINT_CL
#include "walk/cells.cl"

static inline floatW dda_midpoint_integral(const Medium* medium, __global const Voxel* voxels, const MediumRay* ray,
                                           const Segments* at) {
  (void)medium;
  return density_trilinear(voxels, ray, at, lanes_load(at->place), WITHIN_CELL) * lanes_load(at->size);
}

#endif
