// Binary → wide: a node takes in its largest child until it has `width` of them [Wald08]. Every child but one waits on the traversal's stack: where a deep tree would overflow it, nodes take in
// fewer.
#include <algorithm>
#include <limits>
#include <string>

#include "accel/bvh.hpp"
#include "base/error.hpp"
#include "base/float_bits.hpp"

namespace brume {

namespace {

class Collapse {
 public:
  Collapse(FlatBvh& out, const BinaryBvh& tree, int width, const LeafLink& leaf)
      : out_(out), tree_(tree), width_(width), leaf_(leaf) {}

  std::int32_t run() {
    heights_find();
    const std::int32_t root = node_add(0);
    if (stack_need_ > BVH_STACK)
      throw RuntimeError("the BVH needs a traversal stack of " + std::to_string(stack_need_) +
                         " entries; allowed are " + std::to_string(BVH_STACK));
    return root;
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
    const std::size_t at = out_.nodes.size();
    const auto number = static_cast<std::int32_t>(at / BVH_NODE_FLOATS(std::size_t(width_)));
    const float inf = std::numeric_limits<float>::infinity(), absent = bits_as_float(BVH_ABSENT);
    for (int run = 0; run < 7; ++run)
      out_.nodes.insert(out_.nodes.end(), width_, run < 3 ? inf : run < 6 ? -inf : absent);
    const std::vector<std::int32_t> children = children_open(root, pending);
    const int waiting = pending + static_cast<int>(children.size()) - 1;  // one child is popped, the others wait
    stack_need_ = std::max(stack_need_, waiting + 1);
    for (std::size_t lane = 0; lane < children.size(); ++lane) {
      const BinaryNode& child = tree_.nodes[children[lane]];
      const std::size_t first = at + lane;
      for (int axis = 0; axis < 3; ++axis) {
        out_.nodes[first + std::size_t(axis) * width_] = child.lo[axis];
        out_.nodes[first + std::size_t(3 + axis) * width_] = child.hi[axis];
      }
      const std::int32_t link = child.left < 0 ? leaf_(child) : node_add(children[lane], waiting);
      out_.nodes[first + std::size_t(6) * width_] = bits_as_float(link);
    }
    return number;
  }

  FlatBvh& out_;
  const BinaryBvh& tree_;
  int width_;
  const LeafLink& leaf_;
  int stack_need_ = 0;
  std::vector<int> heights_;  // of every binary node: levels below it
};

}  // namespace

int bvh_collapse(FlatBvh& bvh, const BinaryBvh& tree, int width, const LeafLink& leaf) {
  return Collapse(bvh, tree, width, leaf).run();
}

}  // namespace brume
