// What a BVH is worth, read off its flat arrays [Goldsmith87].
#include <algorithm>
#include <cmath>

#include "accel/bvh.hpp"
#include "base/float_bits.hpp"

namespace brume {

namespace {

constexpr double NODE_COST = 1, BLOCK_COST = 0.5;

class Measure {
 public:
  Measure(const FlatBvh& bvh, int width) : bvh_(bvh), width_(static_cast<std::size_t>(width)) {}

  BvhMeasure of_root(int root) {
    BvhMeasure all;
    all.sah_cost = NODE_COST;
    all.depth = below(root, 0, area_of_all(root), all.sah_cost);
    return all;
  }

 private:
  const float* lane(int node, std::size_t lane) const {
    return &bvh_.nodes[static_cast<std::size_t>(node) * BVH_NODE_FLOATS(width_) + lane];
  }
  static double area(const double* lo, const double* hi) {
    const double x = hi[0] - lo[0], y = hi[1] - lo[1], z = hi[2] - lo[2];
    return x * y + y * z + z * x;
  }

  double area_of_all(int node) const {
    double lo[3] = {INFINITY, INFINITY, INFINITY}, hi[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (std::size_t i = 0; i < width_; ++i)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        lo[axis] = std::min<double>(lo[axis], lane(node, i)[axis * width_]);
        hi[axis] = std::max<double>(hi[axis], lane(node, i)[(3 + axis) * width_]);
      }
    return area(lo, hi);
  }

  // Adds the cost of what lies below a node and returns the depth there.
  int below(int node, int depth, double whole, double& cost) const {
    int deepest = depth + 1;
    for (std::size_t i = 0; i < width_; ++i) {
      const float* const p = lane(node, i);
      const std::int32_t link = float_as_bits(p[6 * width_]);
      if (link == BVH_ABSENT) continue;
      const double lo[3] = {p[0], p[width_], p[2 * width_]}, hi[3] = {p[3 * width_], p[4 * width_], p[5 * width_]};
      const double share = whole > 0 ? area(lo, hi) / whole : 1;  // of rays; points and lines are met by all
      cost += share * (link >= 0 ? NODE_COST : BLOCK_COST * (~link & 15));
      if (link >= 0) deepest = std::max(deepest, below(link, depth + 1, whole, cost));
    }
    return deepest;
  }

  const FlatBvh& bvh_;
  std::size_t width_;
};

}  // namespace

BvhMeasure bvh_measure(const FlatBvh& bvh, int root, int width) { return Measure(bvh, width).of_root(root); }

}  // namespace brume
