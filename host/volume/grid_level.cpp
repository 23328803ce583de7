// See grid_level.hpp.
#include "volume/grid_level.hpp"

#include <algorithm>
#include <array>
#include <glm/vec3.hpp>
#include <optional>
#include <utility>
#include <vector>

namespace brume {

namespace {

constexpr int SAMPLES_MAX = 3;  // of the fine grid that a coarse one lies over

// What a coarse sample takes along one axis.
struct Span {
  int first = 0, count = 0;
  std::array<double, SAMPLES_MAX> weights{};
  bool whole = true;  // nothing of it lies beyond the grid
};

// Coarse samples are `spacing` fine ones long.
std::vector<Span> spans_along(int fine, int coarse, double spacing) {
  std::vector<Span> spans(static_cast<std::size_t>(coarse));
  for (int j = 0; j < coarse; ++j) {
    Span& span = spans[static_cast<std::size_t>(j)];
    const double begin = j * spacing, end = (j + 1) * spacing;
    span.first = static_cast<int>(begin);
    for (int i = span.first; i < fine && i < end && span.count < SAMPLES_MAX; ++i)
      span.weights[static_cast<std::size_t>(span.count++)] =
          (std::min(end, i + 1.0) - std::max(begin, double(i))) / spacing;
    span.whole = end <= fine + 1e-9;
  }
  return spans;
}

class Halving {
 public:
  explicit Halving(const Grid& fine) : fine_(fine), coarse_((fine.size() + 1) / 2) {
    for (int axis = 0; axis < 3; ++axis) {
      const int n = fine.size()[axis], m = coarse_.size()[axis];
      const double spacing = fine.border == Border::CLAMP ? double(n) / m : 2.0;
      spans_[static_cast<std::size_t>(axis)] = spans_along(n, m, spacing);
      coarse_.spacing[axis] = fine.spacing[axis] * spacing;
    }
    coarse_.border = fine.border;
    coarse_.world_from_lattice = fine.world_from_lattice;
    coarse_.full_size = fine.full_size;
    coarse_.name = fine.name;
    coarse_.source = fine.source;
    coarse_.notes = fine.notes;
  }

  Grid run() {
    const ivec3 groups = coarse_.groups();
    for (int z = 0; z < groups.z; ++z)
      for (int y = 0; y < groups.y; ++y)
        for (int x = 0; x < groups.x; ++x) group({x, y, z});
    return std::move(coarse_);
  }

 private:
  const Span& span(int axis, int j) const {
    return spans_[static_cast<std::size_t>(axis)][static_cast<std::size_t>(j)];
  }

  // Fine samples of the coarse ones lo ... hi, all of these within the grid.
  ivec3 first_of(ivec3 lo) const { return {span(0, lo.x).first, span(1, lo.y).first, span(2, lo.z).first}; }
  ivec3 last_of(ivec3 hi) const {
    ivec3 last;
    for (int axis = 0; axis < 3; ++axis) last[axis] = span(axis, hi[axis]).first + span(axis, hi[axis]).count - 1;
    return last;
  }
  bool whole(ivec3 hi) const { return span(0, hi.x).whole && span(1, hi.y).whole && span(2, hi.z).whole; }

  // Whether the coarse samples lo ... hi are one value, as which they are then there.
  bool one_value(ivec3 lo, ivec3 hi) {
    const std::optional<float> one = fine_.one_value(first_of(lo), last_of(hi));
    if (!one || (*one != 0 && !whole(hi))) return false;
    if (*one != 0) coarse_.fill(lo, hi, *one);
    return true;
  }

  void group(ivec3 g) {
    const ivec3 lo = g * (GRID_GROUP * GRID_BLOCK),
                hi = glm::min(lo + (GRID_GROUP * GRID_BLOCK - 1), coarse_.size() - 1);
    if (one_value(lo, hi)) return;
    const ivec3 from = lo / GRID_BLOCK, to = hi / GRID_BLOCK;
    for (ivec3 b = from; b.z <= to.z; ++b.z)
      for (b.y = from.y; b.y <= to.y; ++b.y)
        for (b.x = from.x; b.x <= to.x; ++b.x) block(b);
  }

  void block(ivec3 b) {
    const ivec3 lo = b * GRID_BLOCK, hi = glm::min(lo + (GRID_BLOCK - 1), coarse_.size() - 1);
    if (one_value(lo, hi)) return;
    std::array<float, GRID_BLOCK * GRID_BLOCK * GRID_BLOCK> values{};
    for (ivec3 i = lo; i.z <= hi.z; ++i.z)
      for (i.y = lo.y; i.y <= hi.y; ++i.y)
        for (i.x = lo.x; i.x <= hi.x; ++i.x) {
          const glm::uvec3 in_block(i - lo);
          values[in_block.z * 64 + in_block.y * 8 + in_block.x] = mean(i);
        }
    coarse_.set_cube(lo, values.data());
  }

  float mean(ivec3 i) const {
    const Span &x = span(0, i.x), &y = span(1, i.y), &z = span(2, i.z);
    double sum = 0;
    for (int dz = 0; dz < z.count; ++dz)
      for (int dy = 0; dy < y.count; ++dy) {
        double row = 0;
        for (int dx = 0; dx < x.count; ++dx)
          row += x.weights[static_cast<std::size_t>(dx)] * double(fine_.at({x.first + dx, y.first + dy, z.first + dz}));
        sum += z.weights[static_cast<std::size_t>(dz)] * y.weights[static_cast<std::size_t>(dy)] * row;
      }
    return static_cast<float>(sum);
  }

  const Grid& fine_;
  Grid coarse_;
  std::array<std::vector<Span>, 3> spans_;
};

}  // namespace

Grid grid_halved(const Grid& fine) { return Halving(fine).run(); }

}  // namespace brume
