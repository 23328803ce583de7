// How densities are read from memory, as stored.
#ifndef BRUME_LIB_VOXELS_CL
#define BRUME_LIB_VOXELS_CL
#include "lib/lanes.cl"

#if BRUME_STORAGE == 0
typedef float Voxel;
#define LOAD2_VOXEL(p) vload2(0, p)
#elif BRUME_STORAGE == 1
typedef half Voxel;
#define LOAD2_VOXEL(p) vload_half2(0, p)
#else
typedef uchar Voxel;
#define LOAD2_VOXEL(p) convert_float2(vload2(0, p))
#endif
LANES_GATHER2(voxels_gather2, Voxel, LOAD2_VOXEL)

#endif
