// See bvh_split.hpp.
#include "accel/bvh_split.hpp"

#include <array>
#include <cmath>

namespace brume {

namespace {

constexpr int BINS = 32;

std::uint32_t split_list(const BoxRange&) { return 0; }

template <class InFirst>
std::uint32_t parted(const BoxRange& range, const InFirst& in_first) {
  return static_cast<std::uint32_t>(std::partition(range.first, range.first + range.count, in_first) - range.first);
}

// In the middle of the longest axis.
std::uint32_t split_midpoint(const BoxRange& range) {
  int longest = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (range.box.hi[axis] - range.box.lo[axis] > range.box.hi[longest] - range.box.lo[longest]) longest = axis;
  const float middle = 0.5f * range.box.lo[longest] + 0.5f * range.box.hi[longest];
  const std::uint32_t first = parted(range, [&](const BoxRef& r) { return r.middle(longest) < middle; });
  return first < range.count ? first : 0;
}

// Equal parts of the middles along one axis.
struct Bins {
  float low[3], scale[3];  // scale 0: all in one
  int count;

  explicit Bins(const BoxRange& range) : count(static_cast<int>(std::min<std::uint32_t>(BINS, range.count))) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = range.middles.lo[axis];
      const float each = static_cast<float>(count) / (range.middles.hi[axis] - low[axis]);
      scale[axis] = std::isfinite(each) ? each : 0;
    }
  }
  int of(const BoxRef& r, int axis) const {
    return std::clamp(static_cast<int>((r.middle(axis) - low[axis]) * scale[axis]), 0, count - 1);
  }
};

struct Split {
  int axis = -1, bin = 0;
  double cost = std::numeric_limits<double>::infinity();
};

// The cheapest place between bins of one axis: area · (triangles + lanes of their blocks) on either side. Triangles
// alone leave a third of the lanes empty, lanes alone part what is small in the wrong places.
void split_improve(Split& best, int axis, const std::array<Box, BINS>& boxes,
                   const std::array<std::uint32_t, BINS>& counts, int bins, const BoxRange& range) {
  const auto cost = [&](const Box& box, std::uint32_t n) {
    const std::uint32_t blocks = (n + range.leaf_size - 1) / range.leaf_size;
    return box.area() * (n + blocks * range.leaf_size);
  };
  std::array<double, BINS> right_cost{};
  Box right, left;
  std::uint32_t n = 0;
  for (int bin = bins - 1; bin > 0; --bin) {
    right.add(boxes[bin]);
    n += counts[bin];
    right_cost[bin] = cost(right, n);
  }
  n = 0;
  for (int bin = 0; bin + 1 < bins; ++bin) {
    left.add(boxes[bin]);
    n += counts[bin];
    const double both = cost(left, n) + right_cost[bin + 1];
    if (n > 0 && n < range.count && both < best.cost) best = {axis, bin, both};
  }
}

// Where the surface-area heuristic, by bins, says that rays will meet the fewest blocks [Wald07].
std::uint32_t split_sah(const BoxRange& range) {
  const Bins bins(range);
  std::array<std::array<Box, BINS>, 3> boxes;
  std::array<std::array<std::uint32_t, BINS>, 3> counts{};
  for (const BoxRef* r = range.first; r != range.first + range.count; ++r)
    for (int axis = 0; axis < 3; ++axis) {
      const int bin = bins.of(*r, axis);
      boxes[axis][bin].add(r->box);
      ++counts[axis][bin];
    }
  Split best;
  for (int axis = 0; axis < 3; ++axis)
    if (bins.scale[axis] > 0) split_improve(best, axis, boxes[axis], counts[axis], bins.count, range);
  if (best.axis < 0) return 0;
  return parted(range, [&](const BoxRef& r) { return bins.of(r, best.axis) <= best.bin; });
}

}  // namespace

SplitRule split_rule(int rule) {
  constexpr SplitRule RULES[] = {
#define ROW(id, name, help) split_##name,
      BRUME_BVH_RULES(ROW)
#undef ROW
  };
  return RULES[rule];
}

}  // namespace brume
