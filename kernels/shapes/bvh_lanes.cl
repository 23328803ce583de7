// The lanes of the BVH: boxes of a node and triangles of a block that are tested at once. All BRUME_BVH_WIDTH of them,
// or one by one where W = 1. Which lanes meet a condition is a word with a bit for each, so that few are walked fast.
#ifndef BRUME_SHAPES_BVH_LANES_CL
#define BRUME_SHAPES_BVH_LANES_CL
#include "lib/lanes.cl"

#if W == 1
#define BVH_LANES 1
typedef float BvhLanes;
typedef uint BvhMask;
#define bvh_load(p) (*(p))
#define bvh_store(v, p) (*(p) = (v))
#define bvh_mask(condition) ((condition) ? 1u : 0u)
#define bvh_lowest(mask) 0
#else
#define BVH_LANES BRUME_BVH_WIDTH
typedef LANES_GLUE(float, BVH_LANES) BvhLanes;
#define bvh_load(p) LANES_GLUE(vload, BVH_LANES)(0, p)
#define bvh_store(v, p) LANES_GLUE(vstore, BVH_LANES)(v, 0, p)
#if BVH_LANES == 4
typedef uint BvhMask;
#define bvh_mask(condition) (as_uint(convert_char4(condition)) & 0x01010101u)
#define bvh_lowest(mask) ((int)popcount((mask & -mask) - 1u) >> 3)
#else
typedef ulong BvhMask;
#define bvh_mask(condition) (as_ulong(convert_char8(condition)) & 0x0101010101010101ul)
#define bvh_lowest(mask) ((int)popcount((mask & -mask) - 1ul) >> 3)
#endif
#endif

#endif
