// Binary BVH by binned surface-area heuristic [Wald07]. Where the bins cannot separate the centroids, or the tree gets
// deep, the range is halved by index: the depth stays bounded whatever the triangles are.
#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "accel/bvh.hpp"

namespace brume {

namespace {

constexpr int BINS = 16;
constexpr int SAH_DEPTH_MAX = 40;  // below, halves only: at most 32 levels more

struct Box : BvhBox {
  Box() {
    std::fill(lo, lo + 3, std::numeric_limits<float>::infinity());
    std::fill(hi, hi + 3, -std::numeric_limits<float>::infinity());
  }
  void add(const float* p) {
    for (int a = 0; a < 3; ++a) {
      lo[a] = std::min(lo[a], p[a]);
      hi[a] = std::max(hi[a], p[a]);
    }
  }
  void add(const BvhBox& b) {  // not its corners: an empty box has infinite ones
    for (int a = 0; a < 3; ++a) {
      lo[a] = std::min(lo[a], b.lo[a]);
      hi[a] = std::max(hi[a], b.hi[a]);
    }
  }
  double area() const {
    if (!(lo[0] <= hi[0])) return 0;
    const double x = double(hi[0]) - lo[0], y = double(hi[1]) - lo[1], z = double(hi[2]) - lo[2];
    return 2 * (x * y + y * z + z * x);
  }
};

struct Split {
  int axis = -1;
  int bin = 0;
  double cost = std::numeric_limits<double>::infinity();
};

class Builder {
 public:
  Builder(const std::vector<BvhBox>& boxes, std::uint32_t leaf_size) : leaf_size_(leaf_size), boxes_(boxes) {
    tree_.order.resize(boxes.size());
    std::iota(tree_.order.begin(), tree_.order.end(), 0u);
    if (!boxes.empty()) build(0, static_cast<std::uint32_t>(boxes.size()), 0);
  }
  BinaryBvh take() { return std::move(tree_); }

 private:
  double center(std::uint32_t i, int axis) const { return 0.5 * (double(boxes_[i].lo[axis]) + boxes_[i].hi[axis]); }

  std::int32_t build(std::uint32_t first, std::uint32_t count, int depth) {
    const auto index = static_cast<std::int32_t>(tree_.nodes.size());
    tree_.nodes.emplace_back();
    Box box, centers;
    for (std::uint32_t k = first; k < first + count; ++k) {
      const std::uint32_t i = tree_.order[k];
      box.add(boxes_[i]);
      const float c[3] = {float(center(i, 0)), float(center(i, 1)), float(center(i, 2))};
      centers.add(c);
    }
    BinaryNode node;
    std::copy(box.lo, box.lo + 3, node.lo);
    std::copy(box.hi, box.hi + 3, node.hi);
    node.first = first;
    node.count = count;
    if (count > leaf_size_) {
      const std::uint32_t left_count = partition(first, count, centers, depth);
      node.left = build(first, left_count, depth + 1);
      node.right = build(first + left_count, count - left_count, depth + 1);
    }
    tree_.nodes[index] = node;
    return index;
  }

  int bin_of(std::uint32_t i, int axis, const Box& centers) const {
    const double extent = double(centers.hi[axis]) - centers.lo[axis];
    return std::clamp(int(BINS * (center(i, axis) - centers.lo[axis]) / extent), 0, BINS - 1);
  }

  Split split_find(std::uint32_t first, std::uint32_t count, const Box& centers) const {
    Split best;
    for (int axis = 0; axis < 3; ++axis) {
      if (!(centers.hi[axis] > centers.lo[axis])) continue;
      std::array<Box, BINS> boxes;
      std::array<std::uint32_t, BINS> counts{};
      for (std::uint32_t k = first; k < first + count; ++k) {
        const int bin = bin_of(tree_.order[k], axis, centers);
        boxes[bin].add(boxes_[tree_.order[k]]);
        ++counts[bin];
      }
      std::array<double, BINS> right_cost{};
      Box right;
      std::uint32_t n = 0;
      for (int bin = BINS - 1; bin > 0; --bin) {
        right.add(boxes[bin]);
        n += counts[bin];
        right_cost[bin] = right.area() * n;
      }
      Box left;
      n = 0;
      for (int bin = 0; bin + 1 < BINS; ++bin) {
        left.add(boxes[bin]);
        n += counts[bin];
        const double cost = left.area() * n + right_cost[bin + 1];
        if (n > 0 && n < count && cost < best.cost) best = {axis, bin, cost};
      }
    }
    return best;
  }

  // Reorders the range and returns the size of its first part, between 1 and count - 1.
  std::uint32_t partition(std::uint32_t first, std::uint32_t count, const Box& centers, int depth) {
    const Split split = depth < SAH_DEPTH_MAX ? split_find(first, count, centers) : Split{};
    if (split.axis < 0) return count / 2;
    const auto begin = tree_.order.begin() + first;
    const auto middle = std::stable_partition(
        begin, begin + count, [&](std::uint32_t i) { return bin_of(i, split.axis, centers) <= split.bin; });
    return static_cast<std::uint32_t>(middle - begin);
  }

  std::uint32_t leaf_size_;
  const std::vector<BvhBox>& boxes_;
  BinaryBvh tree_;
};

}  // namespace

float BinaryNode::area() const {
  const float x = hi[0] - lo[0], y = hi[1] - lo[1], z = hi[2] - lo[2];
  return 2 * (x * y + y * z + z * x);
}

BinaryBvh bvh_build_binary(const std::vector<BvhBox>& boxes, int leaf_size) {
  return Builder(boxes, static_cast<std::uint32_t>(leaf_size)).take();
}

}  // namespace brume
