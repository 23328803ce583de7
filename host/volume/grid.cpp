// Storage and statistics of a Grid. All products of sizes are taken in double or 64 bits before anything is allocated.
#include "volume/grid.hpp"

#include <cmath>
#include <cstdio>
#include <glm/common.hpp>

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

void grid_expect_fits(std::string_view what, glm::i64vec3 size, double stored) {
  const std::string place(what);
  if (size.x < 1 || size.y < 1 || size.z < 1)
    throw InputError(place + ": a grid of " + size_text(size) + " samples, every size must be at least 1");
  if (size.x > INT32_MAX || size.y > INT32_MAX || size.z > INT32_MAX)
    throw InputError(place + ": a grid of " + size_text(size) + " samples, no size may exceed " +
                     std::to_string(INT32_MAX));
  const glm::i64vec3 blocks = blocks_of(size);
  const double table = double(blocks.x) * double(blocks.y) * double(blocks.z) * sizeof(std::int32_t);
  const double needed = table + stored * sizeof(float);
  if (needed > double(GRID_BYTES_MAX))
    throw InputError(place + ": a grid of " + size_text(size) + " samples needs at least " + bytes_text(needed) +
                     ", allowed are " + std::to_string(GRID_BYTES_MAX));
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
  pool_[static_cast<std::size_t>(number)][sample_index(i)] = value;
}

std::int32_t Grid::block_store() {
  if (stored_bytes() + sizeof(Block) > GRID_BYTES_MAX)
    throw InputError((source.empty() ? "grid" : source) + ": a grid of " + size_text(size_) +
                     " samples needs more than " + std::to_string(GRID_BYTES_MAX) + " bytes, allowed are that many");
  pool_.emplace_back();  // zeros
  return static_cast<std::int32_t>(pool_.size() - 1);
}

const float* Grid::block(ivec3 b) const {
  const std::int32_t number = table_[table_index(b)];
  return number < 0 ? nullptr : pool_[static_cast<std::size_t>(number)].data();
}

GridStats grid_stats(const Grid& grid) {
  GridStats stats{INFINITY, -INFINITY, 0, 0, grid.size(), ivec3(-1)};
  double seen = 0, sum = 0;
  grid_visit_stored(grid, [&](ivec3 i, float value) {
    ++seen;
    sum += value;
    stats.min = std::min(stats.min, value);
    stats.max = std::max(stats.max, value);
    if (value == 0.0f) return;
    ++stats.nonzero;
    stats.nonzero_min = glm::min(stats.nonzero_min, i);
    stats.nonzero_max = glm::max(stats.nonzero_max, i);
  });
  const double all = double(grid.size().x) * double(grid.size().y) * double(grid.size().z);
  if (seen < all) {  // the samples of empty blocks
    stats.min = std::min(stats.min, 0.0f);
    stats.max = std::max(stats.max, 0.0f);
  }
  stats.mean = sum / all;
  return stats;
}

}  // namespace brume
