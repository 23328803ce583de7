// Triangles → binary tree → wide one, with the blocks of its leaves; and the same over boxes.
#include <algorithm>
#include <limits>
#include <string>

#include "accel/bvh.hpp"
#include "base/error.hpp"
#include "base/float_bits.hpp"

namespace brume {

namespace {

BvhBox box_of(const Triangle& t) {
  const auto& [a, b, c] = t.p;
  return {{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})},
          {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})}};
}

// Appends the blocks of so many triangles, which `triangle(k)` numbers; the link to them.
template <class Numbers>
std::int32_t blocks_append(FlatBvh& bvh, const std::vector<Triangle>& triangles, std::uint32_t triangle_count,
                           int width, const Numbers& triangle) {
  const std::size_t w = width, floats = BVH_BLOCK_FLOATS(w), first = bvh.blocks.size() / floats,
                    count = (triangle_count + w - 1) / w;
  if (first >= (1u << 27) || count > BVH_LEAF_BLOCKS_MAX)
    throw RuntimeError("the BVH has " + std::to_string(first) + " leaf blocks; allowed are " + std::to_string(1 << 27));
  for (std::size_t block = 0; block < count; ++block) {
    bvh.blocks.insert(bvh.blocks.end(), 9 * w, 0.0f);
    bvh.blocks.insert(bvh.blocks.end(), w, bits_as_float(-1));
  }
  for (std::uint32_t k = 0; k < triangle_count; ++k) {
    float* lane = &bvh.blocks[(first + k / w) * floats + k % w];
    const float* p = &triangles[triangle(k)].p[0].x;
    for (std::size_t run = 0; run < 9; ++run) lane[run * w] = p[run];
    lane[9 * w] = bits_as_float(static_cast<std::int32_t>(triangle(k)));
  }
  return ~static_cast<std::int32_t>(first * 16 + count);
}

}  // namespace

int bvh_collapse(FlatBvh& bvh, const BinaryBvh& tree, const std::vector<Triangle>& triangles, std::size_t first,
                 int width) {
  return bvh_collapse(bvh, tree, width, [&](const BinaryNode& leaf) {
    return blocks_append(bvh, triangles, leaf.count, width,
                         [&](std::uint32_t k) { return first + tree.order[leaf.first + k]; });
  });
}

int bvh_append(FlatBvh& bvh, const std::vector<Triangle>& triangles, std::size_t first, int width, int rule) {
  std::vector<BvhBox> boxes(triangles.size() - first);
  std::transform(triangles.begin() + static_cast<std::ptrdiff_t>(first), triangles.end(), boxes.begin(), box_of);
  return bvh_collapse(bvh, bvh_build_binary(boxes, width, rule), triangles, first, width);
}

int bvh_append_boxes(FlatBvh& bvh, const std::vector<BvhBox>& boxes, int width,
                     const std::vector<std::int32_t>& names) {
  const BinaryBvh tree = bvh_build_binary(boxes, 1, BVH_SAH);
  return bvh_collapse(bvh, tree, width, [&](const BinaryNode& leaf) {
    const std::uint32_t box = tree.order[leaf.first];
    return ~(names.empty() ? static_cast<std::int32_t>(box) : names[box]);
  });
}

FlatBvh bvh_build(const std::vector<Triangle>& triangles, int width, int rule) {
  FlatBvh bvh;
  if (!triangles.empty()) bvh_append(bvh, triangles, 0, width, rule);
  return bvh;
}

}  // namespace brume
