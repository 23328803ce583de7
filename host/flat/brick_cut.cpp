// See brick_cut.hpp. A brick reads at most two of the grid's blocks along each axis.
#include "flat/brick_cut.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace brume {

namespace {

// Along one axis: where the samples of a brick come from.
struct Axis {
  int block;                                    // the grid's block of the first; the next one is at most one further
  std::array<int, BRICK_SAMPLES> next, within;  // 0 or 1: in which of the two; where in it
  std::array<bool, BRICK_SAMPLES> zero;         // beyond the border of a grid that fades

  Axis(const Grid& grid, int axis, int first) {
    const int last = grid.size()[axis] - 1;
    block = std::clamp(first, 0, last) / GRID_BLOCK;
    for (int i = 0; i < BRICK_SAMPLES; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const int sample = std::clamp(first + i, 0, last);
      next[at] = sample / GRID_BLOCK - block;
      within[at] = sample % GRID_BLOCK;
      zero[at] = sample != first + i;
    }
  }
};

}  // namespace

Brick brick_cut(const Grid& grid, ivec3 b, int pad) {
  const bool fades = grid.border == Border::ZERO && pad > 0;
  const int read = pad > 0 ? BRICK_SAMPLES : BRICK_CELLS;
  const ivec3 first = b * BRICK_CELLS - pad;
  const Axis ax(grid, 0, first.x), ay(grid, 1, first.y), az(grid, 2, first.z);
  const float* blocks[8];
  static constexpr std::array<float, GRID_BLOCK * GRID_BLOCK * GRID_BLOCK> zeros{};
  for (int i = 0; i < 8; ++i) {
    const ivec3 at =
        glm::min(ivec3(ax.block + (i & 1), ay.block + (i >> 1 & 1), az.block + (i >> 2)), grid.blocks() - 1);
    const float* samples = grid.block(at);
    blocks[i] = samples ? samples : zeros.data();
  }
  Brick brick;
  brick.min = INFINITY;
  brick.max = -INFINITY;
  float* out = brick.samples.data();
  for (std::size_t z = 0; z < BRICK_SAMPLES; ++z)
    for (std::size_t y = 0; y < BRICK_SAMPLES; ++y) {
      const float* const* pair = &blocks[(az.next[z] << 2) | (ay.next[y] << 1)];
      const int row = (az.within[z] << 6) | (ay.within[y] << 3);
      const bool zero = fades && (az.zero[z] || ay.zero[y]);
      for (std::size_t x = 0; x < BRICK_SAMPLES; ++x)
        *out++ = zero || (fades && ax.zero[x]) ? 0.0f : pair[ax.next[x]][row | ax.within[x]];
    }
  for (int z = 0; z < read; ++z)
    for (int y = 0; y < read; ++y)
      for (int x = 0; x < read; ++x) {
        const float value =
            brick.samples[(std::size_t(z) * BRICK_SAMPLES + std::size_t(y)) * BRICK_SAMPLES + std::size_t(x)];
        brick.min = std::min(brick.min, value);
        brick.max = std::max(brick.max, value);
      }
  return brick;
}

}  // namespace brume
