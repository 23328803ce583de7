// Wide BVH: every node holds `width` child boxes side by side (SoA), which are tested at once [Wald08]; so do the
// blocks of triangles in leaves. Buffers hold plain floats so that no struct depends on the width. Absolute within the
// buffers:
//   nodes:  per node 7 runs of width: lo_x lo_y lo_z hi_x hi_y hi_z link
//           link as int: >= 0: inner node; < 0: leaf, ~link = first block * 16 + blocks
//           absent child: lo = +inf, hi = -inf, link BVH_ABSENT
//   blocks: per leaf block 10 runs of width: p0_x p0_y p0_z p1_x ... p2_z id
//           id as int: triangle; absent triangle: zeros (never hit), id -1
#ifndef BRUME_SHARED_BVH_H
#define BRUME_SHARED_BVH_H
#include "shared/platform.h"

// ROW(ID, name; host: split_NAME, help): how ranges of triangles are parted.
#define BRUME_BVH_RULES(ROW)                                       \
  ROW(LIST, list, "not at all: every triangle and shape is tried") \
  ROW(MIDPOINT, midpoint, "in the middle of the longest axis")     \
  ROW(SAH, sah, "where rays will meet the fewest triangles, by surface areas")
BRUME_SHARED_BEGIN
enum BvhRule {
#define ROW(id, name, help) BVH_##id,
  BRUME_BVH_RULES(ROW)
#undef ROW
      BVH_RULES
};
BRUME_SHARED_END

#define BVH_NODE_FLOATS(width) (7 * (width))
#define BVH_BLOCK_FLOATS(width) (10 * (width))
#define BVH_STACK 96  // entries; the builder asserts that no traversal can need more
#define BVH_LEAF_BLOCKS_MAX 15
#define BVH_ABSENT 0x7fffffff
#endif
