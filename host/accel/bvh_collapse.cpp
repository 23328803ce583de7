// Binary → wide: a node takes in its largest child until it has `width` of them [Wald08]; leaves become blocks of
// triangles. Every child but one waits on the traversal's stack: where a deep tree would overflow it, nodes take in
// fewer.
#include <algorithm>
#include <limits>
#include <string>

#include "accel/bvh.hpp"
#include "base/error.hpp"

namespace brume {

namespace {

class Collapse {
 public:
  Collapse(const BinaryBvh& tree, const std::vector<Triangle>& triangles, int width)
      : tree_(tree), triangles_(triangles), width_(width) {}

  FlatBvh run() {
    if (tree_.nodes.empty()) return {};
    heights_find();
    node_add(0);
    if (stack_need_ > BVH_STACK)
      throw RuntimeError("the BVH needs a traversal stack of " + std::to_string(stack_need_) +
                         " entries; allowed are " + std::to_string(BVH_STACK));
    return std::move(out_);
  }

 private:
  void heights_find() {
    heights_.assign(tree_.nodes.size(), 0);
    for (std::size_t i = heights_.size(); i-- > 0;) {  // children stand behind their parent
      const BinaryNode& node = tree_.nodes[i];
      if (node.left >= 0) heights_[i] = 1 + std::max(heights_[node.left], heights_[node.right]);
    }
  }

  // Opened two by two, a child of height h needs h + 1 entries beside those that wait: that many always remain.
  int children_max(std::int32_t root, int pending) const {
    return std::clamp(BVH_STACK - pending - (heights_[root] - 1), 2, width_);
  }

  std::vector<std::int32_t> children_open(std::int32_t root, int pending) const {
    std::vector<std::int32_t> open{root};
    if (tree_.nodes[root].left < 0) return open;
    const int most = children_max(root, pending);
    while (static_cast<int>(open.size()) < most) {
      std::size_t largest = open.size();
      for (std::size_t i = 0; i < open.size(); ++i)
        if (tree_.nodes[open[i]].left >= 0 &&
            (largest == open.size() || tree_.nodes[open[i]].area() > tree_.nodes[open[largest]].area()))
          largest = i;
      if (largest == open.size()) break;
      const std::int32_t node = open[largest];
      open[largest] = tree_.nodes[node].left;
      open.push_back(tree_.nodes[node].right);
    }
    return open;
  }

  // Appends the wide node under a binary one and returns its number. `pending` counts entries that may wait on the
  // stack above it.
  std::int32_t node_add(std::int32_t root, int pending = 0) {
    const auto number = static_cast<std::int32_t>(out_.links.size() / width_);
    const float inf = std::numeric_limits<float>::infinity();
    out_.links.resize(out_.links.size() + width_, BVH_ABSENT);
    for (int run = 0; run < 6; ++run) out_.nodes.insert(out_.nodes.end(), width_, run < 3 ? inf : -inf);
    const std::vector<std::int32_t> children = children_open(root, pending);
    const int waiting = pending + static_cast<int>(children.size()) - 1;  // one child is popped, the others wait
    stack_need_ = std::max(stack_need_, waiting + 1);
    for (std::size_t lane = 0; lane < children.size(); ++lane) {
      const BinaryNode& child = tree_.nodes[children[lane]];
      for (int axis = 0; axis < 3; ++axis) {
        out_.nodes[(6 * std::size_t(number) + axis) * width_ + lane] = child.lo[axis];
        out_.nodes[(6 * std::size_t(number) + 3 + axis) * width_ + lane] = child.hi[axis];
      }
      const std::int32_t link = child.left < 0 ? leaf_add(child) : node_add(children[lane], waiting);
      out_.links[std::size_t(number) * width_ + lane] = link;
    }
    return number;
  }

  std::int32_t leaf_add(const BinaryNode& leaf) {
    const std::size_t first = out_.ids.size() / width_, count = (leaf.count + width_ - 1) / width_;
    if (first >= (1u << 27) || count > BVH_LEAF_BLOCKS_MAX)
      throw RuntimeError("the BVH has " + std::to_string(first) + " leaf blocks; allowed are " +
                         std::to_string(1 << 27));
    out_.ids.resize(out_.ids.size() + count * width_, -1);
    out_.blocks.resize(out_.blocks.size() + count * 9 * width_, 0.0f);
    for (std::uint32_t k = 0; k < leaf.count; ++k) {
      const std::uint32_t triangle = tree_.order[leaf.first + k];
      const std::size_t block = first + k / width_, lane = k % width_;
      out_.ids[block * width_ + lane] = static_cast<std::int32_t>(triangle);
      const float* p = &triangles_[triangle].p[0].x;
      for (int run = 0; run < 9; ++run) out_.blocks[(block * 9 + run) * width_ + lane] = p[run];
    }
    return ~static_cast<std::int32_t>(first * 16 + count);
  }

  const BinaryBvh& tree_;
  const std::vector<Triangle>& triangles_;
  int width_;
  int stack_need_ = 0;
  std::vector<int> heights_;  // of every binary node: levels below it
  FlatBvh out_;
};

}  // namespace

FlatBvh bvh_collapse(const BinaryBvh& tree, const std::vector<Triangle>& triangles, int width) {
  return Collapse(tree, triangles, width).run();
}

FlatBvh bvh_build(const std::vector<Triangle>& triangles, int width) {
  return bvh_collapse(bvh_build_binary(triangles, width), triangles, width);
}

}  // namespace brume
