// How densities are read from memory, as stored.
#ifndef BRUME_LIB_VOXELS_CL
#define BRUME_LIB_VOXELS_CL
#include "lib/lanes.cl"

#if BRUME_STORAGE == 0
typedef float Voxel;
#define LOAD2_VOXEL(p) vload2(0, p)
#define LOAD_VOXEL(i, p) ((p)[i])
#define LOAD4_VOXEL(i, p) vload4(i, p)
#elif BRUME_STORAGE == 1
typedef half Voxel;
#define LOAD2_VOXEL(p) vload_half2(0, p)
#define LOAD_VOXEL(i, p) vload_half(i, p)
#define LOAD4_VOXEL(i, p) vload_half4(i, p)
#else
typedef uchar Voxel;
#define LOAD2_VOXEL(p) convert_float2(vload2(0, p))
#define LOAD_VOXEL(i, p) convert_float((p)[i])
#define LOAD4_VOXEL(i, p) convert_float4(vload4(i, p))
#endif
LANES_GATHER2(voxels_gather2, Voxel, LOAD2_VOXEL)

#endif
