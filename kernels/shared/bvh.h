// Wide BVH: every node holds BVH_WIDTH child boxes side by side (SoA), so that W lanes test W boxes at once.
// The width is a multiple of the lanes; buffers hold plain floats so that no struct depends on the width:
//   nodes:  per node 6*width floats  lo_x[width] lo_y hi_x ... (order lo_x lo_y lo_z hi_x hi_y hi_z); absent child: lo
//   = +inf, hi = -inf
//   links:  per node width ints      child >= 0: inner node;  child < 0: leaf block range, ~child = first block * 16 +
//   block count
//   blocks: per leaf block 9*width floats p0_x[width] p0_y p0_z p1_x ... p2_z; absent triangle: all NaN-free zeros
//   (never hit)
//   ids:    per leaf block width ints  triangle index, -1 where absent
#ifndef BRUME_SHARED_BVH_H
#define BRUME_SHARED_BVH_H
#include "shared/platform.h"

#define BVH_STACK 96  // entries; the builder asserts that no traversal can need more
#define BVH_LEAF_BLOCKS_MAX 15
#define BVH_ABSENT 0x7fffffff  // link of an absent child
#endif
