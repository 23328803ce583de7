// Statistics of a Grid: what is not stored is 0.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "volume/grid.hpp"

namespace brume {

namespace {

void box_add(GridStats& stats, ivec3 lo, ivec3 hi) {
  stats.nonzero_min = glm::min(stats.nonzero_min, lo);
  stats.nonzero_max = glm::max(stats.nonzero_max, hi);
}

// The samples lo ... hi, all of one value.
void one_add(GridStats& stats, ivec3 lo, ivec3 hi, float value, double& sum) {
  const double count = double(hi.x - lo.x + 1) * double(hi.y - lo.y + 1) * double(hi.z - lo.z + 1);
  sum += count * value;
  stats.min = std::min(stats.min, value);
  stats.max = std::max(stats.max, value);
  if (value == 0.0f) return;
  stats.nonzero += static_cast<std::size_t>(count);
  box_add(stats, lo, hi);
}

// Those of a block. Eight columns along x side by side: the compiler makes vectors of that.
void block_add(GridStats& stats, ivec3 lo, ivec3 hi, const float* samples, double& sum) {
  const ivec3 n = hi - lo;
  double sums[GRID_BLOCK] = {};
  float min[GRID_BLOCK], max[GRID_BLOCK];
  int nonzero[GRID_BLOCK] = {};
  std::fill_n(min, GRID_BLOCK, stats.min);
  std::fill_n(max, GRID_BLOCK, stats.max);
  for (int z = 0; z <= n.z; ++z)
    for (int y = 0; y <= n.y; ++y) {
      const float* row = samples + (((z << 3) | y) << 3);
      for (int x = 0; x < GRID_BLOCK; ++x) sums[x] += row[x];  // 0 beyond the grid
      for (int x = 0; x < GRID_BLOCK; ++x) min[x] = row[x] < min[x] ? row[x] : min[x];
      for (int x = 0; x < GRID_BLOCK; ++x) max[x] = row[x] > max[x] ? row[x] : max[x];
      for (int x = 0; x < GRID_BLOCK; ++x) nonzero[x] += row[x] != 0.0f;
    }
  for (int x = 0; x <= n.x; ++x) {
    sum += sums[x];
    stats.min = std::min(stats.min, min[x]);
    stats.max = std::max(stats.max, max[x]);
    stats.nonzero += static_cast<std::size_t>(nonzero[x]);
  }
  if (lo == glm::max(lo, stats.nonzero_min) && hi == glm::min(hi, stats.nonzero_max)) return;  // the box holds it
  for (ivec3 i(0); i.z <= n.z; ++i.z)
    for (i.y = 0; i.y <= n.y; ++i.y)
      for (i.x = 0; i.x <= n.x; ++i.x)
        if (samples[(((i.z << 3) | i.y) << 3) | i.x] != 0.0f) box_add(stats, lo + i, lo + i);
}

}  // namespace

GridStats grid_stats(const Grid& grid) {
  GridStats stats{INFINITY, -INFINITY, 0, 0, grid.size(), ivec3(-1)};
  double sum = 0, seen = 0;
  const ivec3 last = grid.size() - 1, blocks = grid.blocks();
  grid_visit_blocks(grid, [&](ivec3 b) {
    ++seen;
    const ivec3 lo = b * GRID_BLOCK, hi = glm::min(lo + (GRID_BLOCK - 1), last);
    if (grid.block_uniform(b))
      one_add(stats, lo, hi, *grid.block(b), sum);
    else
      block_add(stats, lo, hi, grid.block(b), sum);
  });
  if (seen < double(blocks.x) * double(blocks.y) * double(blocks.z)) one_add(stats, ivec3(0), ivec3(0), 0, sum);
  const dvec3 size(grid.size());
  stats.mean = sum / (size.x * size.y * size.z);
  return stats;
}

}  // namespace brume
