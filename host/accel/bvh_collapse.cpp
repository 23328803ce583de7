// Binary → wide: of all ways to take nodes together in wide ones, that which rays pay the least for, from the leaves up
// [Ylitie17]. Every child but one waits on the traversal's stack: where a deep tree would overflow it, nodes take in
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
    costs_find();
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

  // cost(node, k): of what lies below, as at most k children of a wide node; a child is a leaf, which costs nothing
  // here, or a wide node itself, which every ray through it pays for once.
  float& cost(std::size_t node, int k) { return costs_[node * static_cast<std::size_t>(width_) + k - 1]; }

  // How many of k children the left part takes at best; 0: fewer than k cost as little.
  int left_share(const BinaryNode& node, int k, float least, float& best) {
    int share = 0;
    best = least;
    for (int left = 1; left < k; ++left) {
      const float both = cost(node.left, left) + cost(node.right, k - left);
      if (both < best) {
        best = both;
        share = left;
      }
    }
    return share;
  }

  void costs_find() {
    costs_.assign(tree_.nodes.size() * static_cast<std::size_t>(width_), 0.0f);
    for (std::size_t i = tree_.nodes.size(); i-- > 0;) {
      const BinaryNode& node = tree_.nodes[i];
      if (node.left < 0) continue;
      float opened = 0;
      left_share(node, width_, std::numeric_limits<float>::infinity(), opened);
      cost(i, 1) = node.area() + opened;
      for (int k = 2; k <= width_; ++k) left_share(node, k, cost(i, k - 1), cost(i, k));
    }
  }

  // The children of a wide node below `node`, at most k of them.
  void children_add(std::int32_t number, int k, std::vector<std::int32_t>& children) {
    const BinaryNode& node = tree_.nodes[number];
    float best = 0;
    while (k > 1 && node.left >= 0) {
      if (const int left = left_share(node, k, cost(number, k - 1), best)) {
        children_add(node.left, left, children);
        children_add(node.right, k - left, children);
        return;
      }
      --k;
    }
    children.push_back(number);
  }

  std::vector<std::int32_t> children_of(std::int32_t root, int pending) {
    const BinaryNode& node = tree_.nodes[root];
    if (node.left < 0) return {root};
    std::vector<std::int32_t> children;
    float best = 0;
    const int most = children_max(root, pending);
    const int left = left_share(node, most, std::numeric_limits<float>::infinity(), best);
    children_add(node.left, left, children);
    children_add(node.right, most - left, children);
    return children;
  }

  // Appends the wide node under a binary one and returns its number. `pending` counts entries that may wait on the
  // stack above it.
  std::int32_t node_add(std::int32_t root, int pending = 0) {
    const std::size_t at = out_.nodes.size();
    const auto number = static_cast<std::int32_t>(at / BVH_NODE_FLOATS(std::size_t(width_)));
    const float inf = std::numeric_limits<float>::infinity(), absent = bits_as_float(BVH_ABSENT);
    for (int run = 0; run < 7; ++run)
      out_.nodes.insert(out_.nodes.end(), width_, run < 3 ? inf : run < 6 ? -inf : absent);
    const std::vector<std::int32_t> children = children_of(root, pending);
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
  std::vector<float> costs_;
  std::vector<int> heights_;  // of every binary node: levels below it
};

}  // namespace

int bvh_collapse(FlatBvh& bvh, const BinaryBvh& tree, int width, const LeafLink& leaf) {
  return Collapse(bvh, tree, width, leaf).run();
}

}  // namespace brume
