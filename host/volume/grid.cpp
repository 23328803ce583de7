// Storage and statistics of a Grid. All products of sizes are taken in double or 64 bits before anything is allocated.
#include "volume/grid.hpp"

#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "base/error.hpp"

#ifdef __GLIBC__
#include <malloc.h>
#endif

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

constexpr std::size_t TRIM_BLOCKS = 2048;  // 4 MiB: less is not worth the walk through the heap

// To the system: what is freed in the middle of the heap would stay with the process.
void memory_return() {
#ifdef __GLIBC__
  ::malloc_trim(0);
#endif
}

glm::i64vec3 pieces_of(glm::i64vec3 size, int side) { return (size + std::int64_t{side - 1}) / std::int64_t{side}; }
glm::i64vec3 groups_of(glm::i64vec3 size) { return pieces_of(size, GRID_BLOCK * GRID_GROUP); }

bool within_box(ivec3 lo, ivec3 hi, ivec3 box_lo, ivec3 box_hi) {
  return glm::all(glm::lessThanEqual(box_lo, lo)) && glm::all(glm::lessThanEqual(hi, box_hi));
}

template <class Visit>
void visit_box(ivec3 lo, ivec3 hi, Visit visit) {
  for (ivec3 i = lo; i.z <= hi.z; ++i.z)
    for (i.y = lo.y; i.y <= hi.y; ++i.y)
      for (i.x = lo.x; i.x <= hi.x; ++i.x) visit(i);
}

}  // namespace

void grid_expect_fits(std::string_view what, glm::i64vec3 size, double stored, std::uint64_t allowed) {
  const std::string place(what);
  if (size.x < 1 || size.y < 1 || size.z < 1)
    throw InputError(place + ": a grid of " + size_text(size) + " samples, every size must be at least 1");
  if (size.x > INT32_MAX || size.y > INT32_MAX || size.z > INT32_MAX)
    throw InputError(place + ": a grid of " + size_text(size) + " samples, no size may exceed " +
                     std::to_string(INT32_MAX));
  const glm::dvec3 groups(groups_of(size));
  const double index = groups.x * groups.y * groups.z * sizeof(std::int32_t);
  if (index > double(GRID_INDEX_MAX))
    throw InputError(place + ": a grid of " + size_text(size) + " samples needs an index of " + bytes_text(index) +
                     ", allowed are " + std::to_string(GRID_INDEX_MAX));
  const double needed = index + stored * sizeof(float);
  if (needed > double(allowed))
    throw InputError(place + ": a grid of " + size_text(size) + " samples needs at least " + bytes_text(needed) +
                     ", allowed are " + std::to_string(allowed));
}

Grid::Grid(ivec3 size) : full_size(size), size_(size) {
  grid_expect_fits("grid", size, 0);
  blocks_ = ivec3(pieces_of(size, GRID_BLOCK));
  groups_size_ = ivec3(groups_of(size));
  table_.assign(table_index(groups_size_ - 1) + 1, EMPTY);
}

void Grid::set(ivec3 i, float value) {
  if (at(i) == value) return;
  (*block_writable(block_entry(i >> 3)))[within(i)] = value;
}

// The entry of a block, in a group of its own.
std::int32_t& Grid::block_entry(ivec3 b) {
  std::int32_t& group = table_[table_index(b >> 3)];
  if (group < 0) {
    group = group_store(EMPTY);
  } else if (shared_group_[static_cast<std::size_t>(group)]) {
    const std::int32_t all = (*groups_[static_cast<std::size_t>(group)])[0];
    group = group_store(all);
  }
  return (*groups_[static_cast<std::size_t>(group)])[within(b)];
}

// The block of an entry, stored and shared with none.
Grid::Block* Grid::block_writable(std::int32_t& number) {
  if (number < 0 || shared_block_[static_cast<std::size_t>(number)]) {
    const std::int32_t own = block_store();
    if (number >= 0) *pool_[static_cast<std::size_t>(own)] = *pool_[static_cast<std::size_t>(number)];
    number = own;
  }
  return pool_[static_cast<std::size_t>(number)].get();
}

void Grid::expect_room() const {
  if (stored_bytes() + sizeof(Block) > GRID_BYTES_MAX)
    throw InputError((source.empty() ? "grid" : source) + ": a grid of " + size_text(size_) +
                     " samples needs more than " + std::to_string(GRID_BYTES_MAX) + " bytes, allowed are that many");
}

std::int32_t Grid::block_store() {
  expect_room();
  ++stored_;
  auto zeros = std::make_unique<Block>(Block{});
  if (!free_.empty()) {
    const std::int32_t number = free_.back();
    free_.pop_back();
    pool_[static_cast<std::size_t>(number)] = std::move(zeros);
    return number;
  }
  pool_.push_back(std::move(zeros));
  shared_block_.push_back(false);
  return static_cast<std::int32_t>(pool_.size() - 1);
}

std::int32_t Grid::block_of(float value, ivec3 extent) {
  if (value == 0) return EMPTY;
  const auto [known, is_new] = blocks_of_.try_emplace({value, extent.x, extent.y, extent.z}, EMPTY);
  if (!is_new) return known->second;
  known->second = block_store();
  Block& block = *pool_[static_cast<std::size_t>(known->second)];
  visit_box(ivec3(0), extent - 1, [&](ivec3 i) { block[within(i)] = value; });
  shared_block_[static_cast<std::size_t>(known->second)] = true;
  return known->second;
}

std::int32_t Grid::group_store(std::int32_t all) {
  expect_room();
  groups_.push_back(std::make_unique<Group>());
  groups_.back()->fill(all);
  shared_group_.push_back(false);
  return static_cast<std::int32_t>(groups_.size() - 1);
}

std::int32_t Grid::group_of(float value) {
  if (value == 0) return EMPTY;
  const auto [known, is_new] = groups_of_.try_emplace(value, EMPTY);
  if (!is_new) return known->second;
  known->second = group_store(block_of(value, ivec3(GRID_BLOCK)));
  shared_group_[static_cast<std::size_t>(known->second)] = true;
  return known->second;
}

// A block that has become one value throughout gives its memory back.
void Grid::block_join(ivec3 b, std::int32_t& number) {
  if (number < 0 || shared_block_[static_cast<std::size_t>(number)]) return;
  const Block& block = *pool_[static_cast<std::size_t>(number)];
  const ivec3 extent = block_extent(b);
  const float value = block[0];
  for (ivec3 i(0); i.z < extent.z; ++i.z)
    for (i.y = 0; i.y < extent.y; ++i.y)
      for (i.x = 0; i.x < extent.x; ++i.x)
        if (block[within(i)] != value) return;
  pool_[static_cast<std::size_t>(number)].reset();
  --stored_;
  free_.push_back(number);
  number = block_of(value, extent);
}

void Grid::fill_part(ivec3 b, ivec3 lo, ivec3 hi, float value) {
  const ivec3 extent = block_extent(b), begin = b * GRID_BLOCK, end = begin + extent - 1;
  std::int32_t& number = block_entry(b);
  const bool owned = number >= 0 && !shared_block_[static_cast<std::size_t>(number)];
  if (!owned && within_box(begin, end, lo, hi)) {
    number = block_of(value, extent);
    return;
  }
  if (number < 0 && value == 0) return;
  Block& block = *block_writable(number);
  visit_box(glm::max(lo, begin), glm::min(hi, end), [&](ivec3 i) { block[within(i)] = value; });
  block_join(b, number);
}

void Grid::fill(ivec3 lo, ivec3 hi, float value) {
  visit_box(lo >> 6, hi >> 6, [&](ivec3 g) {
    const ivec3 first = g * GRID_GROUP, begin = first * GRID_BLOCK, end = begin + (GRID_GROUP * GRID_BLOCK - 1);
    const bool fresh = group_empty(g) || shared_group_[static_cast<std::size_t>(table_[table_index(g)])];
    if (fresh && within_box(begin, end, lo, hi)) {
      table_[table_index(g)] = group_of(value);
      return;
    }
    if (group_empty(g) && value == 0) return;
    visit_box(glm::max(first, lo >> 3), glm::min(first + (GRID_GROUP - 1), hi >> 3),
              [&](ivec3 b) { fill_part(b, lo, hi, value); });
  });
}

void Grid::set_cube(ivec3 lo, const float* values) {
  const ivec3 hi = glm::min(lo + (GRID_BLOCK - 1), size_ - 1);
  visit_box(glm::max(lo, ivec3(0)) >> 3, hi >> 3, [&](ivec3 b) {
    const ivec3 from = glm::max(glm::max(lo, b * GRID_BLOCK), ivec3(0)),
                to = glm::min(hi, b * GRID_BLOCK + (GRID_BLOCK - 1));
    Block* block = nullptr;
    for (int z = from.z; z <= to.z; ++z)
      for (int y = from.y; y <= to.y; ++y) {
        const float* row = values + ((((z - lo.z) << 3) | (y - lo.y)) << 3) - lo.x;
        for (int x = from.x; x <= to.x; ++x) {
          if (row[x] == 0) continue;
          if (!block) block = block_writable(block_entry(b));
          (*block)[within({x, y, z})] = row[x];
        }
      }
    if (block) block_join(b, block_entry(b));
  });
}

bool Grid::block_is_one(ivec3 b) const {
  const std::int32_t number = block_number(b);
  return number < 0 || shared_block_[static_cast<std::size_t>(number)];
}

const float* Grid::block(ivec3 b) const {
  const std::int32_t number = block_number(b);
  return number < 0 ? nullptr : pool_[static_cast<std::size_t>(number)]->data();
}

std::optional<float> Grid::one_value(ivec3 lo, ivec3 hi) const {
  const float value = at(lo);
  const ivec3 first = lo >> 3, last = hi >> 3;
  const auto is_it = [&](std::int32_t block) {
    return block < 0 ? value == 0
                     : shared_block_[static_cast<std::size_t>(block)] &&
                           (*pool_[static_cast<std::size_t>(block)])[0] == value;
  };
  const auto group_is_it = [&](ivec3 g) {
    const std::int32_t number = table_[table_index(g)];
    if (number < 0) return value == 0;
    const Group& group = *groups_[static_cast<std::size_t>(number)];
    if (shared_group_[static_cast<std::size_t>(number)]) return is_it(group[0]);
    const ivec3 from = glm::max(first, g * GRID_GROUP), to = glm::min(last, g * GRID_GROUP + (GRID_GROUP - 1));
    for (ivec3 b = from; b.z <= to.z; ++b.z)
      for (b.y = from.y; b.y <= to.y; ++b.y)
        for (b.x = from.x; b.x <= to.x; ++b.x)
          if (!is_it(group[within(b)])) return false;
    return true;
  };
  for (ivec3 g = first >> 3; g.z <= last.z >> 3; ++g.z)
    for (g.y = first.y >> 3; g.y <= last.y >> 3; ++g.y)
      for (g.x = first.x >> 3; g.x <= last.x >> 3; ++g.x)
        if (!group_is_it(g)) return std::nullopt;
  return value;
}

std::size_t Grid::group_release(ivec3 g, int block_z) {
  std::int32_t& number = table_[table_index(g)];
  const bool whole = (g.z + 1) * GRID_GROUP <= block_z;
  std::size_t released = 0;
  if (number >= 0 && !shared_group_[static_cast<std::size_t>(number)]) {
    std::unique_ptr<Group>& group = groups_[static_cast<std::size_t>(number)];
    const auto end =
        static_cast<std::size_t>(whole ? GRID_GROUP : block_z - g.z * GRID_GROUP) * GRID_GROUP * GRID_GROUP;
    for (std::size_t i = 0; i < end; ++i) {
      std::int32_t& block = (*group)[i];
      if (block >= 0 && !shared_block_[static_cast<std::size_t>(block)]) {
        pool_[static_cast<std::size_t>(block)].reset();
        ++released;
      }
      block = EMPTY;
    }
    if (whole) group.reset();
  }
  if (whole) number = EMPTY;
  return released;
}

void Grid::release_below(int block_z) {
  std::size_t released = 0;
  for (ivec3 g(0, 0, released_ / GRID_GROUP); g.z < std::min((block_z - 1) / GRID_GROUP + 1, groups_size_.z); ++g.z)
    for (g.y = 0; g.y < groups_size_.y; ++g.y)
      for (g.x = 0; g.x < groups_size_.x; ++g.x) released += group_release(g, block_z);
  released_ = block_z;
  stored_ -= released;
  if (released > TRIM_BLOCKS) memory_return();
}

}  // namespace brume
