// Grid → bricks. Nearest: cell c is voxel c. Trilinear: samples are padded by one on each side (by the border rule), so
// that padded sample s = i + 1 sits at cell-space position s, which is lattice + 0.5.
#include "flat/bricks.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <glm/vector_relational.hpp>
#include <map>
#include <optional>
#include <string_view>
#include <unordered_map>

#include "base/error.hpp"
#include "flat/brick_cut.hpp"
#include "flat/flatten_parts.hpp"

namespace brume {

namespace {

// 32-bit offsets into the voxels and the index: kernels gather with int lanes.
constexpr std::int64_t OFFSET_MAX = 0x7fffffff;

std::size_t index_of(ivec3 i, int nx, int ny) {
  return (static_cast<std::size_t>(i.z) * static_cast<std::size_t>(ny) + static_cast<std::size_t>(i.y)) *
             static_cast<std::size_t>(nx) +
         static_cast<std::size_t>(i.x);
}

std::size_t hash_of(const BrickSamples& samples) {
  return std::hash<std::string_view>()({reinterpret_cast<const char*>(samples.data()), sizeof samples});
}

// The cells in which the density is not 0: what lies outside of them need not be crossed, lit or given a light grid.
struct Occupied {
  ivec3 lo{0x7fffffff}, hi{-1};  // cells [lo, hi)

  // Samples [begin, end); sample s reaches the cells from s - pad to s.
  void add(ivec3 begin, ivec3 end, int pad) {
    lo = glm::min(lo, begin - pad);
    hi = glm::max(hi, end);
  }
  bool holds(ivec3 begin, ivec3 end) const {
    return glm::all(glm::greaterThanEqual(begin, lo)) && glm::all(glm::lessThanEqual(end, hi));
  }
};

class Cutter {
 public:
  Cutter(const Grid& grid, Medium& medium, FlatScene& scene)
      : grid_(grid),
        medium_(medium),
        scene_(scene),
        pad_(medium.interpolation == INTERPOLATION_TRILINEAR ? 1 : 0),
        read_(pad_ > 0 ? BRICK_SAMPLES : BRICK_CELLS),
        fades_(grid.border == Border::ZERO && pad_ > 0),
        cells_(grid.size() + pad_),
        bricks_((cells_ - 1) / BRICK_CELLS + 1),
        blocks_((bricks_ - 1) / BRICK_BLOCK + 1) {}

  // `done`: called with z when the grid's blocks below z are no longer read.
  void run(const std::function<void(int z)>& done) {
    geometry_set();
    index_begin();
    scene_.voxels.reserve(scene_.voxels.size() + stored_count() * BRICK_VALUES);
    visit_blocks([&](ivec3 block) {
      block_cut(block);
      if (block.x == blocks_.x - 1 && block.y == blocks_.y - 1) done((block.z + 1) * BRICK_BLOCK - pad_);
    });
    region_cut();
  }

 private:
  void geometry_set();
  void index_begin();
  template <class Visit>
  void visit_blocks(Visit visit) const;
  template <class Visit>
  void visit_bricks(ivec3 block, Visit visit) const;
  std::size_t stored_count() const;
  std::optional<float> one_value(ivec3 b, int side) const;
  bool of_stored_blocks(ivec3 b) const;
  void block_cut(ivec3 block);
  std::int32_t brick_cut_entry(ivec3 b);
  std::int32_t constant_entry(float value);
  std::int32_t store(const Brick& brick);
  std::int32_t entries_append(std::int32_t all);
  void occupied_add(const Brick& brick, ivec3 first);
  void region_cut();

  const Grid& grid_;
  Medium& medium_;
  FlatScene& scene_;
  const int pad_, read_;
  const bool fades_;
  const ivec3 cells_, bricks_, blocks_;
  std::map<float, std::int32_t> constants_;                  // stored bricks of one value
  std::unordered_multimap<std::size_t, std::int32_t> same_;  // stored bricks by the hash of their samples
  std::map<std::int32_t, std::int32_t> whole_blocks_;  // where the entries of blocks of one entry throughout begin
  Occupied occupied_;
};

template <class Visit>
void Cutter::visit_blocks(Visit visit) const {
  for (ivec3 block(0); block.z < blocks_.z; ++block.z)
    for (block.y = 0; block.y < blocks_.y; ++block.y)
      for (block.x = 0; block.x < blocks_.x; ++block.x) visit(block);
}

// The bricks of a block that the grid has.
template <class Visit>
void Cutter::visit_bricks(ivec3 block, Visit visit) const {
  const ivec3 first = block * BRICK_BLOCK, end = glm::min(first + BRICK_BLOCK, bricks_);
  for (ivec3 b = first; b.z < end.z; ++b.z)
    for (b.y = first.y; b.y < end.y; ++b.y)
      for (b.x = first.x; b.x < end.x; ++b.x) visit(b);
}

void Cutter::geometry_set() {
  const double lo = pad_ > 0 && grid_.border == Border::CLAMP ? 0.5 : 0.0;
  medium_.lo = packed(dvec3(lo));
  medium_.hi = packed(dvec3(cells_) - lo);
  medium_.cells_x = cells_.x;
  medium_.cells_y = cells_.y;
  medium_.cells_z = cells_.z;
  medium_.brick_nx = bricks_.x;
  medium_.brick_ny = bricks_.y;
  medium_.brick_nz = bricks_.z;
  medium_.brick_offset = static_cast<int>(scene_.bricks.size());
}

// Room for the index of blocks.
void Cutter::index_begin() {
  const std::int64_t blocks = std::int64_t{blocks_.x} * blocks_.y * blocks_.z;
  if (blocks + medium_.brick_offset > OFFSET_MAX)
    throw InputError(grid_.source + ": " + std::to_string(blocks_.x) + "x" + std::to_string(blocks_.y) + "x" +
                     std::to_string(blocks_.z) + " blocks of bricks are more than 2^31");
  scene_.bricks.resize(scene_.bricks.size() + static_cast<std::size_t>(blocks), BRICK_EMPTY);
}

// How many bricks are stored that no other can share, and a few more: so that the samples are not moved while they
// are appended.
std::size_t Cutter::stored_count() const {
  std::size_t count = 64;
  visit_blocks([&](ivec3 block) {
    if (!one_value(block * BRICK_BLOCK, BRICK_BLOCK))
      visit_bricks(block, [&](ivec3 b) { count += of_stored_blocks(b); });
  });
  return count;
}

// The one value of all samples that the side³ bricks from b on read, where the blocks of the grid tell it.
std::optional<float> Cutter::one_value(ivec3 b, int side) const {
  const ivec3 last = grid_.size() - 1, begin = b * BRICK_CELLS - pad_, end = begin + side * BRICK_CELLS;
  const std::optional<float> value =
      grid_.one_value(glm::clamp(begin, ivec3(0), last), glm::clamp(end, ivec3(0), last));
  const bool beyond = begin != glm::max(begin, ivec3(0)) || end != glm::min(end, last);
  return value && *value != 0 && fades_ && beyond ? std::nullopt : value;
}

// Stores the samples and returns their number.
std::int32_t Cutter::store(const Brick& brick) {
  if (static_cast<std::int64_t>(scene_.voxels.size()) + BRICK_VALUES > OFFSET_MAX)
    throw InputError(grid_.source + ": more than " + std::to_string(OFFSET_MAX / BRICK_VALUES) +
                     " bricks of 8x8x8 cells hold values; allowed are that many (8 GiB)");
  const auto number = static_cast<std::int32_t>(scene_.voxels.size() / BRICK_VALUES);
  scene_.voxels.insert(scene_.voxels.end(), brick.samples.begin(), brick.samples.end());
  scene_.brick_ranges.insert(scene_.brick_ranges.end(), {brick.min, brick.max});
  return number;
}

std::int32_t Cutter::constant_entry(float value) {
  if (!(value > 0)) return BRICK_EMPTY;
  const auto [known, is_new] = constants_.try_emplace(value, 0);
  if (is_new) {
    Brick brick{{}, value, value};
    brick.samples.fill(value);
    known->second = store(brick);
  }
  return known->second;
}

// Whether the brick reads a block that is not one value throughout. Others are many and alike: the sides of a box, say.
bool Cutter::of_stored_blocks(ivec3 b) const {
  const ivec3 last = grid_.size() - 1, begin = b * BRICK_CELLS - pad_;
  const ivec3 lo = glm::clamp(begin, ivec3(0), last) / GRID_BLOCK;
  const ivec3 hi = glm::clamp(begin + BRICK_CELLS, ivec3(0), last) / GRID_BLOCK;
  for (ivec3 i = lo; i.z <= hi.z; ++i.z)
    for (i.y = lo.y; i.y <= hi.y; ++i.y)
      for (i.x = lo.x; i.x <= hi.x; ++i.x)
        if (!grid_.block_is_one(i)) return true;
  return false;
}

std::int32_t Cutter::brick_cut_entry(ivec3 b) {
  const ivec3 first = b * BRICK_CELLS;
  if (const std::optional<float> one = one_value(b, 1)) {
    if (*one > 0) occupied_.add(first, first + read_, pad_);
    return constant_entry(*one);
  }
  const Brick brick = brick_cut(grid_, b, pad_);
  if (!(brick.max > 0)) return BRICK_EMPTY;
  occupied_add(brick, first);
  if (brick.min == brick.max) {
    const auto [known, is_new] = constants_.try_emplace(brick.min, 0);
    if (is_new) known->second = store(brick);
    return known->second;
  }
  if (medium_.liquid >= 0 || of_stored_blocks(b)) return store(brick);
  const std::size_t hash = hash_of(brick.samples);
  const auto [begin, end] = same_.equal_range(hash);
  for (auto i = begin; i != end; ++i)
    if (std::equal(brick.samples.begin(), brick.samples.end(),
                   &scene_.voxels[static_cast<std::size_t>(i->second) * BRICK_VALUES]))
      return i->second;
  return same_.emplace(hash, store(brick))->second;
}

// Entries of a block of bricks, all the same at first; returns where they begin.
std::int32_t Cutter::entries_append(std::int32_t all) {
  if (static_cast<std::int64_t>(scene_.bricks.size()) + BRICK_BLOCK_ENTRIES > OFFSET_MAX)
    throw InputError(grid_.source + ": the index of its bricks is larger than 8 GiB");
  const auto begin = static_cast<std::int32_t>(scene_.bricks.size());
  scene_.bricks.resize(scene_.bricks.size() + BRICK_BLOCK_ENTRIES, all);
  return begin;
}

void Cutter::block_cut(ivec3 block) {
  const ivec3 first = block * BRICK_BLOCK;
  const std::size_t at = static_cast<std::size_t>(medium_.brick_offset) + index_of(block, blocks_.x, blocks_.y);
  if (const std::optional<float> one = one_value(first, BRICK_BLOCK)) {
    const std::int32_t entry = constant_entry(*one);
    if (*one > 0) {
      const ivec3 begin = first * BRICK_CELLS, last = glm::min(first + BRICK_BLOCK, bricks_) - 1;
      occupied_.add(begin, last * BRICK_CELLS + read_, pad_);
    }
    const auto [known, is_new] = whole_blocks_.try_emplace(entry, 0);
    if (is_new) known->second = entries_append(entry);
    scene_.bricks[at] = known->second;
    return;
  }
  const std::int32_t begin = entries_append(BRICK_EMPTY);
  scene_.bricks[at] = begin;
  visit_bricks(block, [&](ivec3 b) {
    const std::int32_t entry = brick_cut_entry(b);
    scene_.bricks[static_cast<std::size_t>(begin) + index_of(b - first, BRICK_BLOCK, BRICK_BLOCK)] = entry;
  });
}

void Cutter::occupied_add(const Brick& brick, ivec3 first) {
  if (occupied_.holds(first, first + read_)) return;
  for (int z = 0; z < read_; ++z)
    for (int y = 0; y < read_; ++y)
      for (int x = 0; x < read_; ++x) {
        if (brick.samples[(std::size_t(z) * BRICK_SAMPLES + std::size_t(y)) * BRICK_SAMPLES + std::size_t(x)] == 0)
          continue;
        const ivec3 sample = first + ivec3(x, y, z);
        occupied_.add(sample, sample + 1, pad_);
      }
}

void Cutter::region_cut() {
  if (occupied_.hi.x < 0) return;
  const double lo = pad_ > 0 && grid_.border == Border::CLAMP ? 0.5 : 0.0;
  medium_.lo = packed(glm::max(dvec3(lo), dvec3(occupied_.lo)));
  medium_.hi = packed(glm::min(dvec3(cells_) - lo, dvec3(occupied_.hi)));
}

}  // namespace

BrickGrid brick_grid_of(const Medium& m) {
  return {m.brick_offset, m.cells_x, m.cells_y, m.cells_z, m.brick_nx, m.brick_ny, m.brick_nz};
}

void bricks_append(const Grid& grid, Medium& medium, FlatScene& scene) {
  Cutter(grid, medium, scene).run([](int) {});
}

void bricks_append(Grid&& grid, Medium& medium, FlatScene& scene) {
  Cutter(grid, medium, scene).run([&](int z) { grid.release_below(z); });
  grid.release_below(grid.groups().z * GRID_GROUP);
}

std::int32_t brick_block_entries(const FlatScene& scene, const Medium& medium, glm::ivec3 block) {
  const ivec3 blocks = (ivec3(medium.brick_nx, medium.brick_ny, medium.brick_nz) - 1) / BRICK_BLOCK + 1;
  return scene.bricks.at(static_cast<std::size_t>(medium.brick_offset) + index_of(block, blocks.x, blocks.y));
}

std::int32_t brick_entry(const FlatScene& scene, const Medium& medium, glm::ivec3 b) {
  const std::int32_t begin = brick_block_entries(scene, medium, b / BRICK_BLOCK);
  return scene.bricks.at(static_cast<std::size_t>(begin) + index_of(b % BRICK_BLOCK, BRICK_BLOCK, BRICK_BLOCK));
}

}  // namespace brume
