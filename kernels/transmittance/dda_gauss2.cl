// dda_gauss2: trilinear density along a ray is a cubic inside a cell, so two Gauss–Legendre points are exact.
#ifndef BRUME_TRANSMITTANCE_DDA_GAUSS2_CL
#define BRUME_TRANSMITTANCE_DDA_GAUSS2_CL
#include "transmittance/cells.cl"

static inline floatW dda_gauss2_integral(const Medium* medium, __global const voxel_t* voxels, const MediumRay* ray,
                                         const Segments* at) {
  (void)medium;
  const floatW middle = lanes_load(at->place), size = lanes_load(at->size);
  const floatW away = size * 0.288675134594813f;  // 1 / (2 √3)
  const floatW sum = density_trilinear(voxels, ray, at, middle - away, REACH_CELL) +
                     density_trilinear(voxels, ray, at, middle + away, REACH_CELL);
  return 0.5f * size * sum;
}

#endif
