// How a range of boxes is parted in two: one function a row of BRUME_BVH_RULES. Private to host/accel.
#pragma once
#include <algorithm>
#include <limits>

#include "accel/bvh.hpp"

namespace brume {

struct Box : BvhBox {
  Box() {
    std::fill(lo, lo + 3, std::numeric_limits<float>::infinity());
    std::fill(hi, hi + 3, -std::numeric_limits<float>::infinity());
  }
  void add(const BvhBox& b) {
    for (int a = 0; a < 3; ++a) {
      lo[a] = std::min(lo[a], b.lo[a]);
      hi[a] = std::max(hi[a], b.hi[a]);
    }
  }
  void add(const float* p) {
    for (int a = 0; a < 3; ++a) {
      lo[a] = std::min(lo[a], p[a]);
      hi[a] = std::max(hi[a], p[a]);
    }
  }
  double area() const {
    if (!(lo[0] <= hi[0])) return 0;
    const double x = double(hi[0]) - lo[0], y = double(hi[1]) - lo[1], z = double(hi[2]) - lo[2];
    return 2 * (x * y + y * z + z * x);
  }
};

// A box and its number, moved about as ranges are parted.
struct BoxRef {
  BvhBox box;
  std::uint32_t index;
  float middle(int axis) const { return 0.5f * box.lo[axis] + 0.5f * box.hi[axis]; }
};

struct BoxRange {
  BoxRef* first;
  std::uint32_t count;
  Box box, middles;  // around the boxes, around their middles
  std::uint32_t leaf_size;
};

// Reorders the range, the same way every time, and returns the size of its first part; 0 where it finds none.
using SplitRule = std::uint32_t (*)(const BoxRange&);
SplitRule split_rule(int rule);

}  // namespace brume
