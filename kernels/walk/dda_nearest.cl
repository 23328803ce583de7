// dda_nearest: the density of a voxel is constant, so density times length is exact.
#ifndef BRUME_WALK_DDA_NEAREST_CL
#define BRUME_WALK_DDA_NEAREST_CL
#include "walk/cells.cl"

static inline floatW dda_nearest_integral(const Medium* medium, __global const Voxel* voxels, const MediumRay* ray,
                                          const Segments* at) {
  (void)medium;
  return density_nearest(voxels, ray, at, lanes_load(at->place), WITHIN_CELL) * lanes_load(at->size);
}

#endif
