// Binary BVH by a rule of bvh_split.hpp. Where the rule finds no place, or the tree gets deep, the range is halved as
// it stands: the depth stays bounded whatever the boxes are. Large ranges are built side by side.
#include <future>

#include "accel/bvh_split.hpp"

namespace brume {

namespace {

constexpr int RULE_DEPTH_MAX = 40;              // below, halves only: at most 32 levels more
constexpr int PARALLEL_DEPTH = 4;               // levels whose parts are built side by side: up to 16 at once
constexpr std::uint32_t PARALLEL_LEAST = 4096;  // boxes in a range that is worth a thread

using Nodes = std::vector<BinaryNode>;

class Builder {
 public:
  Builder(const std::vector<BvhBox>& boxes, int leaf_size, int rule)
      : leaf_size_(static_cast<std::uint32_t>(leaf_size)), rule_(rule), split_(split_rule(rule)) {
    refs_.reserve(boxes.size());
    for (const BvhBox& box : boxes) {
      refs_.push_back({box, static_cast<std::uint32_t>(refs_.size())});
      whole_.add(box);
    }
  }

  BinaryBvh run() {
    BinaryBvh tree;
    if (!refs_.empty()) tree.nodes = build(0, static_cast<std::uint32_t>(refs_.size()), 0);
    tree.order.reserve(refs_.size());
    for (const BoxRef& ref : refs_) tree.order.push_back(ref.index);
    return tree;
  }

 private:
  BoxRange range_of(std::uint32_t first, std::uint32_t count) {
    BoxRange range{refs_.data() + first, count, {}, {}, leaf_size_};
    for (const BoxRef* r = range.first; r != range.first + count; ++r) {
      const float middle[3] = {r->middle(0), r->middle(1), r->middle(2)};
      range.box.add(r->box);
      range.middles.add(middle);
    }
    return range;
  }

  // The node of a range; *left_count: of its first part, 0 for a leaf.
  BinaryNode node_of(std::uint32_t first, std::uint32_t count, int depth, std::uint32_t* left_count) {
    const BoxRange range = range_of(first, count);
    const Box& box = rule_ == BVH_LIST ? whole_ : range.box;  // a list leaves nothing out
    BinaryNode node{};
    std::copy(box.lo, box.lo + 3, node.lo);
    std::copy(box.hi, box.hi + 3, node.hi);
    node.first = first;
    node.count = count;
    *left_count = count > leaf_size_ && depth < RULE_DEPTH_MAX ? split_(range) : 0;
    if (count > leaf_size_ && *left_count == 0) *left_count = count / 2;
    return node;
  }

  void build_into(Nodes& nodes, std::uint32_t first, std::uint32_t count, int depth) {
    const std::size_t at = nodes.size();
    std::uint32_t left_count = 0;
    nodes.push_back(node_of(first, count, depth, &left_count));
    nodes[at].left = nodes[at].right = -1;
    if (left_count == 0) return;
    nodes[at].left = static_cast<std::int32_t>(nodes.size());
    build_into(nodes, first, left_count, depth + 1);
    nodes[at].right = static_cast<std::int32_t>(nodes.size());
    build_into(nodes, first + left_count, count - left_count, depth + 1);
  }

  static std::int32_t nodes_append(Nodes& nodes, const Nodes& more) {
    const auto offset = static_cast<std::int32_t>(nodes.size());
    for (BinaryNode node : more) {
      if (node.left >= 0) {
        node.left += offset;
        node.right += offset;
      }
      nodes.push_back(node);
    }
    return offset;
  }

  // The same nodes in the same order, however many are built at a time; by this thread where there is no other to have.
  Nodes build(std::uint32_t first, std::uint32_t count, int depth) {
    Nodes nodes;
    if (depth >= PARALLEL_DEPTH || count < PARALLEL_LEAST) {
      build_into(nodes, first, count, depth);
      return nodes;
    }
    std::uint32_t left_count = 0;
    nodes.push_back(node_of(first, count, depth, &left_count));
    std::future<Nodes> right = std::async(std::launch::async | std::launch::deferred, &Builder::build, this,
                                          first + left_count, count - left_count, depth + 1);
    nodes[0].left = nodes_append(nodes, build(first, left_count, depth + 1));
    nodes[0].right = nodes_append(nodes, right.get());
    return nodes;
  }

  std::uint32_t leaf_size_;
  int rule_;
  SplitRule split_;
  Box whole_;
  std::vector<BoxRef> refs_;
};

}  // namespace

float BinaryNode::area() const {
  const float x = hi[0] - lo[0], y = hi[1] - lo[1], z = hi[2] - lo[2];
  return 2 * (x * y + y * z + z * x);
}

BinaryBvh bvh_build_binary(const std::vector<BvhBox>& boxes, int leaf_size, int rule) {
  return Builder(boxes, leaf_size, rule).run();
}

}  // namespace brume
