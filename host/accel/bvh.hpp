// Triangles → the flattened wide BVH of shared/bvh.h. No traversal here: kernels do that.
#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "shared/bvh.h"
#include "shared/shape.h"

namespace brume {

struct FlatBvh {
  std::vector<float> nodes, blocks;
};

// The box of something that a BVH is over.
struct BvhBox {
  float lo[3], hi[3];
};

// Appends the BVH of the triangles from `first` on and returns the number of its root; links and ids count from the
// start of the buffers and of `triangles`. width: children per node and triangles per block, 4 or 8. rule: BVH_x.
// At least one triangle. Deterministic, on all cores. Fits the traversal's stack whatever the triangles are. Throws
// RuntimeError for more blocks than the 27 bits of a leaf link.
int bvh_append(FlatBvh& bvh, const std::vector<Triangle>& triangles, std::size_t first, int width, int rule = BVH_SAH);
// The same over boxes, one or more: nodes alone, the link to box i is ~names[i]; without names ~i.
int bvh_append_boxes(FlatBvh& bvh, const std::vector<BvhBox>& boxes, int width,
                     const std::vector<std::int32_t>& names = {});
// Of all triangles, root 0. No triangles: empty arrays.
FlatBvh bvh_build(const std::vector<Triangle>& triangles, int width, int rule = BVH_SAH);

// What a ray through the box of the root costs: how many nodes it opens, and half as much for each block of triangles
// that it looks at, in the mean over rays from everywhere [Goldsmith87].
struct BvhMeasure {
  double sah_cost = 0;
  int depth = 0;  // nodes from the root to the deepest leaf
};
BvhMeasure bvh_measure(const FlatBvh& bvh, int root, int width);

// The binary tree under it, exposed for the collapse and for tests.
struct BinaryNode {
  float lo[3], hi[3];
  std::int32_t left = -1, right = -1;  // -1: a leaf
  std::uint32_t first = 0, count = 0;  // of the leaf's boxes in `order`
  float area() const;
};
struct BinaryBvh {
  std::vector<BinaryNode> nodes;     // node 0 is the root
  std::vector<std::uint32_t> order;  // of boxes, leaves hold ranges of it
};
BinaryBvh bvh_build_binary(const std::vector<BvhBox>& boxes, int leaf_size, int rule = BVH_SAH);
// Appends the wide tree of a binary one and returns the number of its root. leaf: what a link to that leaf is; below 0.
// Throws RuntimeError for a tree so deep that no choice of nodes fits the traversal's stack too.
using LeafLink = std::function<std::int32_t(const BinaryNode&)>;
int bvh_collapse(FlatBvh& bvh, const BinaryBvh& tree, int width, const LeafLink& leaf);
// With the blocks of its leaves, whose boxes are those of the triangles from `first` on.
int bvh_collapse(FlatBvh& bvh, const BinaryBvh& tree, const std::vector<Triangle>& triangles, std::size_t first,
                 int width);

}  // namespace brume
