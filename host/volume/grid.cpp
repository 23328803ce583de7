// Storage and statistics of a Grid. All products of sizes are taken in double or 64 bits before anything is allocated.
#include "volume/grid.hpp"

#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "base/error.hpp"

namespace brume {

namespace {

std::string size_text(glm::i64vec3 size) {
  return std::to_string(size.x) + "x" + std::to_string(size.y) + "x" + std::to_string(size.z);
}

std::string bytes_text(double bytes) {
  char text[64];
  std::snprintf(text, sizeof text, "%.0f bytes", bytes);
  return text;
}

glm::i64vec3 blocks_of(glm::i64vec3 size) { return (size + std::int64_t{GRID_BLOCK - 1}) / std::int64_t{GRID_BLOCK}; }

}  // namespace

void grid_expect_fits(std::string_view what, glm::i64vec3 size, double stored, std::uint64_t allowed) {
  const std::string place(what);
  if (size.x < 1 || size.y < 1 || size.z < 1)
    throw InputError(place + ": a grid of " + size_text(size) + " samples, every size must be at least 1");
  if (size.x > INT32_MAX || size.y > INT32_MAX || size.z > INT32_MAX)
    throw InputError(place + ": a grid of " + size_text(size) + " samples, no size may exceed " +
                     std::to_string(INT32_MAX));
  const glm::i64vec3 blocks = blocks_of(size);
  const double table = double(blocks.x) * double(blocks.y) * double(blocks.z) * sizeof(std::int32_t);
  const double needed = table + stored * sizeof(float);
  if (needed > double(allowed))
    throw InputError(place + ": a grid of " + size_text(size) + " samples needs at least " + bytes_text(needed) +
                     ", allowed are " + std::to_string(allowed));
}

Grid::Grid(ivec3 size) : size_(size) {
  grid_expect_fits("grid", size, 0);
  blocks_ = ivec3(blocks_of(size));
  table_.assign(table_index(blocks_ - 1) + 1, -1);
}

void Grid::set(ivec3 i, float value) {
  std::int32_t& number = table_[table_index(i >> 3)];
  if (number < 0) {
    if (value == 0.0f) return;
    number = block_store();
  }
  if (shared_[static_cast<std::size_t>(number)]) {
    if (pool_[static_cast<std::size_t>(number)][0] == value) return;
    block_own(number);
  }
  pool_[static_cast<std::size_t>(number)][sample_index(i)] = value;
}

std::int32_t Grid::block_store() {
  if (stored_bytes() + sizeof(Block) > GRID_BYTES_MAX)
    throw InputError((source.empty() ? "grid" : source) + ": a grid of " + size_text(size_) +
                     " samples needs more than " + std::to_string(GRID_BYTES_MAX) + " bytes, allowed are that many");
  pool_.emplace_back();  // zeros
  shared_.push_back(false);
  return static_cast<std::int32_t>(pool_.size() - 1);
}

void Grid::block_own(std::int32_t& number) {
  const std::int32_t own = block_store();
  pool_[static_cast<std::size_t>(own)] = pool_[static_cast<std::size_t>(number)];
  number = own;
}

std::int32_t Grid::block_uniform_of(float value) {
  const auto [known, is_new] = uniform_.try_emplace(value, -1);
  if (!is_new) return known->second;
  known->second = block_store();
  pool_[static_cast<std::size_t>(known->second)].fill(value);
  shared_[static_cast<std::size_t>(known->second)] = true;
  return known->second;
}

void Grid::fill(ivec3 lo, ivec3 hi, float value) {
  const ivec3 first = lo >> 3, last = hi >> 3;
  const std::int32_t uniform = value == 0 ? -1 : block_uniform_of(value);
  for (ivec3 b = first; b.z <= last.z; ++b.z)
    for (b.y = first.y; b.y <= last.y; ++b.y)
      for (b.x = first.x; b.x <= last.x; ++b.x) {
        const ivec3 begin = b * GRID_BLOCK, end = begin + (GRID_BLOCK - 1);
        if (glm::all(glm::lessThanEqual(lo, begin)) && glm::all(glm::lessThanEqual(end, hi))) {
          table_[table_index(b)] = uniform;
          continue;
        }
        const ivec3 from = glm::max(lo, begin), to = glm::min(hi, end);
        for (ivec3 i = from; i.z <= to.z; ++i.z)
          for (i.y = from.y; i.y <= to.y; ++i.y)
            for (i.x = from.x; i.x <= to.x; ++i.x) set(i, value);
      }
}

bool Grid::block_uniform(ivec3 b) const {
  const std::int32_t number = table_[table_index(b)];
  return number < 0 || shared_[static_cast<std::size_t>(number)];
}

const float* Grid::block(ivec3 b) const {
  const std::int32_t number = table_[table_index(b)];
  return number < 0 ? nullptr : pool_[static_cast<std::size_t>(number)].data();
}

namespace {

void stats_add(GridStats& stats, ivec3 lo, ivec3 hi, float value, double& sum) {
  const double count = double(hi.x - lo.x + 1) * double(hi.y - lo.y + 1) * double(hi.z - lo.z + 1);
  sum += count * value;
  stats.min = std::min(stats.min, value);
  stats.max = std::max(stats.max, value);
  if (value == 0.0f) return;
  stats.nonzero += static_cast<std::size_t>(count);
  stats.nonzero_min = glm::min(stats.nonzero_min, lo);
  stats.nonzero_max = glm::max(stats.nonzero_max, hi);
}

}  // namespace

GridStats grid_stats(const Grid& grid) {
  GridStats stats{INFINITY, -INFINITY, 0, 0, grid.size(), ivec3(-1)};
  double sum = 0;
  const ivec3 blocks = grid.blocks(), last = grid.size() - 1;
  for (ivec3 b(0); b.z < blocks.z; ++b.z)
    for (b.y = 0; b.y < blocks.y; ++b.y)
      for (b.x = 0; b.x < blocks.x; ++b.x) {
        const ivec3 lo = b * GRID_BLOCK, hi = glm::min(lo + (GRID_BLOCK - 1), last);
        const float* samples = grid.block(b);
        if (!samples || grid.block_uniform(b)) {
          stats_add(stats, lo, hi, samples ? samples[0] : 0.0f, sum);
          continue;
        }
        for (ivec3 i = lo; i.z <= hi.z; ++i.z)
          for (i.y = lo.y; i.y <= hi.y; ++i.y)
            for (i.x = lo.x; i.x <= hi.x; ++i.x) stats_add(stats, i, i, grid.at(i), sum);
      }
  const dvec3 size(grid.size());
  stats.mean = sum / (size.x * size.y * size.z);
  return stats;
}

}  // namespace brume
