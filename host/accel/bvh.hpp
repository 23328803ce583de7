// Triangles → the flattened wide BVH of shared/bvh.h. No traversal here: kernels do that.
#pragma once
#include <cstdint>
#include <vector>

#include "shared/bvh.h"
#include "shared/shape.h"

namespace brume {

struct FlatBvh {
  std::vector<float> nodes, blocks;
  std::vector<std::int32_t> links, ids;
};

// width: children per node and triangles per block, 4, 8 or 16. No triangles: empty arrays. Deterministic.
// Fits the traversal's stack whatever the triangles are. Throws RuntimeError for more blocks than the 27 bits of a leaf
// link.
FlatBvh bvh_build(const std::vector<Triangle>& triangles, int width);

// The binary tree under it, exposed for the collapse and for tests.
struct BinaryNode {
  float lo[3], hi[3];
  std::int32_t left = -1, right = -1;  // -1: a leaf
  std::uint32_t first = 0, count = 0;  // of the leaf's triangles in `order`
  float area() const;
};
struct BinaryBvh {
  std::vector<BinaryNode> nodes;     // node 0 is the root
  std::vector<std::uint32_t> order;  // triangle indices, leaves hold ranges of them
};
BinaryBvh bvh_build_binary(const std::vector<Triangle>& triangles, int leaf_size);
// Throws RuntimeError for a tree so deep that no choice of nodes fits the traversal's stack too.
FlatBvh bvh_collapse(const BinaryBvh& tree, const std::vector<Triangle>& triangles, int width);

}  // namespace brume
