// How densities are read from memory, as stored.
#ifndef BRUME_LIB_VOXELS_CL
#define BRUME_LIB_VOXELS_CL
#include "lib/lanes.cl"

#if BRUME_STORAGE == 0
typedef float voxel_t;
#define LOAD2_VOXEL(p) vload2(0, p)
#elif BRUME_STORAGE == 1
typedef half voxel_t;
#define LOAD2_VOXEL(p) vload_half2(0, p)
#else
typedef uchar voxel_t;
#define LOAD2_VOXEL(p) convert_float2(vload2(0, p))
#endif
LANES_GATHER2(voxels_gather2, voxel_t, LOAD2_VOXEL)

#endif
