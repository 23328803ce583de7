// A scalar field on a regular lattice, stored sparsely: blocks of 8³ samples, and groups of 8³ blocks, of which neither
// exists where all is 0 nor twice where all is one value. What files and generators make and what flatten cuts into
// bricks. Knows nothing of coefficients, cameras or kernels.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/ext/vector_int3_sized.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace brume {

using glm::dmat4;
using glm::dvec3;
using glm::ivec3;

inline constexpr int GRID_BLOCK = 8;                           // samples along a side of a block
inline constexpr int GRID_GROUP = 8;                           // blocks along a side of a group
inline constexpr std::uint64_t GRID_BYTES_MAX = 8ull << 30;    // of one grid; larger ones are refused
inline constexpr std::uint64_t GRID_INDEX_MAX = 128ull << 20;  // of those for its index: one int per 64³ samples

// What lies beyond the outermost samples.
//   CLAMP: samples at (i+0.5)/n of the bounds; within half a voxel of the border the outermost sample goes on
//   (generators, raw).
//   ZERO:  samples at integer index; everything outside is 0, so trilinear fades over one voxel (OpenVDB).
enum class Border { CLAMP, ZERO };

class Grid {
 public:
  // Every size >= 1, all samples 0. Throws InputError for other sizes and for more groups than GRID_INDEX_MAX can
  // index.
  explicit Grid(ivec3 size);

  ivec3 size() const { return size_; }
  float at(ivec3 i) const;         // 0 <= i < size
  void set(ivec3 i, float value);  // stores a block on its first non-zero value; InputError beyond GRID_BYTES_MAX
  // The same value in the box lo ... hi (inclusive, within the grid). Whole blocks of one value are stored once,
  // however many
  // calls it takes to fill them.
  void fill(ivec3 lo, ivec3 hi, float value);
  // Those of 8³ values, x fastest, that are not 0: the first at sample lo, anywhere within the grid or up to 7 before
  // it. Values
  // beyond the grid must be 0.
  void set_cube(ivec3 lo, const float* values);
  std::size_t stored_bytes() const {
    return stored_ * sizeof(Block) + groups_.size() * sizeof(Group) + table_.size() * sizeof(std::int32_t);
  }

  // Block b holds samples 8b ... 8b+7 of each axis, x fastest, then y, z; those beyond the grid are 0. 0 <= b < blocks.
  ivec3 blocks() const { return blocks_; }
  bool block_empty(ivec3 b) const { return block_number(b) < 0; }  // all 0 and not stored
  const float* block(ivec3 b) const;                               // its 512 samples, nullptr where empty
  // Stored as one value throughout, or empty; the second: within the grid.
  bool block_uniform(ivec3 b) const { return block_is_one(b) && block_extent(b) == ivec3(GRID_BLOCK); }
  bool block_is_one(ivec3 b) const;
  ivec3 groups() const { return groups_size_; }
  bool group_empty(ivec3 g) const { return table_[table_index(g)] < 0; }  // all of its blocks are
  // The one value of all blocks that the box of samples lo ... hi (inclusive, within the grid) meets, where they are
  // stored as such.
  std::optional<float> one_value(ivec3 lo, ivec3 hi) const;
  // Gives back the memory of the blocks below this z, block by block: they read as 0 from then on.
  void release_below(int block_z);

  Border border = Border::CLAMP;
  // World position of lattice coordinates: sample i sits at world_from_lattice * (i + 0.5, i + 0.5, i + 0.5). In
  // lattice
  // coordinates voxel i spans [i, i+1), so CLAMP grids fill [0, size] and ZERO grids reach half a voxel further when
  // trilinear.
  dmat4 world_from_lattice{1.0};
  // Of an averaged grid (grid_level.hpp): how many samples of the full one its own are apart, along each axis, and how
  // many that one has; world_from_lattice is then that of the full one.
  dvec3 spacing{1.0};
  ivec3 full_size;
  std::string name;                // of the grid within its file
  std::string source;              // file or generator, for messages and info
  std::vector<std::string> notes;  // what a user should be told: cleaned voxels, ...

 private:
  using Block = std::array<float, GRID_BLOCK * GRID_BLOCK * GRID_BLOCK>;
  using Group = std::array<std::int32_t, GRID_GROUP * GRID_GROUP * GRID_GROUP>;  // EMPTY or number of a block in pool_
  static constexpr std::int32_t EMPTY = -1;

  static std::size_t index_of(ivec3 i, ivec3 size) {
    return (static_cast<std::size_t>(i.z) * static_cast<std::size_t>(size.y) + static_cast<std::size_t>(i.y)) *
               static_cast<std::size_t>(size.x) +
           static_cast<std::size_t>(i.x);
  }
  std::size_t table_index(ivec3 g) const { return index_of(g, groups_size_); }
  static std::size_t within(ivec3 i) {  // of a sample in its block, a block in its group
    return static_cast<std::size_t>(((i.z & 7) << 6) | ((i.y & 7) << 3) | (i.x & 7));
  }
  std::int32_t block_number(ivec3 b) const {
    const std::int32_t group = table_[table_index(b >> 3)];
    return group < 0 ? EMPTY : (*groups_[static_cast<std::size_t>(group)])[within(b)];
  }
  std::int32_t& block_entry(ivec3 b);
  Block* block_writable(std::int32_t& number);
  std::int32_t block_store();
  ivec3 block_extent(ivec3 b) const { return glm::min(size_ - b * GRID_BLOCK, ivec3(GRID_BLOCK)); }
  std::int32_t block_of(float value, ivec3 extent);
  std::int32_t group_store(std::int32_t all);
  std::int32_t group_of(float value);
  void block_join(ivec3 b, std::int32_t& number);
  void fill_part(ivec3 b, ivec3 lo, ivec3 hi, float value);
  std::size_t group_release(ivec3 g, int block_z);
  void expect_room() const;

  ivec3 size_, blocks_, groups_size_;
  std::vector<std::int32_t> table_;  // EMPTY or number of a group
  std::vector<std::unique_ptr<Group>> groups_;
  std::vector<std::unique_ptr<Block>> pool_;
  std::vector<std::int32_t> free_;                 // of the pool: given back
  int released_ = 0;                               // blocks below this z are given back
  std::size_t stored_ = 0;                         // blocks of the pool that exist
  std::vector<bool> shared_block_, shared_group_;  // per number: one of those below
  std::map<std::tuple<float, int, int, int>, std::int32_t>
      blocks_of_;                            // one value within the grid: by it and how far that is
  std::map<float, std::int32_t> groups_of_;  // whole groups of one value
};

inline float Grid::at(ivec3 i) const {
  const std::int32_t number = block_number(i >> 3);
  return number < 0 ? 0.0f : (*pool_[static_cast<std::size_t>(number)])[within(i)];
}

// Calls visit(b) for every stored block b: by z, then y, then x. `visit` may set samples of stored blocks.
template <class Visit>
void grid_visit_blocks(const Grid& grid, Visit visit) {
  const ivec3 groups = grid.groups(), blocks = grid.blocks();
  std::vector<ivec3> stored;  // of one layer
  for (int gz = 0; gz < groups.z; ++gz) {
    stored.clear();
    for (int gy = 0; gy < groups.y; ++gy)
      for (int gx = 0; gx < groups.x; ++gx)
        if (!grid.group_empty({gx, gy, gz})) stored.push_back(ivec3(gx, gy, gz) * GRID_GROUP);
    const int end = std::min((gz + 1) * GRID_GROUP, blocks.z);
    for (int z = gz * GRID_GROUP; z < end && !stored.empty(); ++z)
      for (std::size_t row = 0, next; row < stored.size(); row = next) {
        for (next = row; next < stored.size() && stored[next].y == stored[row].y;) ++next;
        for (int y = stored[row].y; y < std::min(stored[row].y + GRID_GROUP, blocks.y); ++y)
          for (std::size_t i = row; i < next; ++i)
            for (int x = stored[i].x; x < std::min(stored[i].x + GRID_GROUP, blocks.x); ++x)
              if (!grid.block_empty({x, y, z})) visit(ivec3(x, y, z));
      }
  }
}

// Calls visit(i, value) for every sample of every stored block, block by block, x fastest within each. `visit` may set
// samples of stored blocks.
template <class Visit>
void grid_visit_stored(const Grid& grid, Visit visit) {
  grid_visit_blocks(grid, [&](ivec3 b) {
    const float* samples = grid.block(b);
    const ivec3 lo = b * GRID_BLOCK, n = glm::min(grid.size() - lo, ivec3(GRID_BLOCK));
    for (int z = 0; z < n.z; ++z)
      for (int y = 0; y < n.y; ++y)
        for (int x = 0; x < n.x; ++x) visit(lo + ivec3(x, y, z), samples[(z * GRID_BLOCK + y) * GRID_BLOCK + x]);
  });
}

// Throws InputError "<what>: <size> samples ... need N bytes, allowed are M" where a grid of that size with `stored`
// samples would exceed `allowed` bytes. To be asked before anything is allocated.
void grid_expect_fits(std::string_view what, glm::i64vec3 size, double stored, std::uint64_t allowed = GRID_BYTES_MAX);

struct GridStats {
  float min, max;
  double mean;
  std::size_t nonzero;
  ivec3 nonzero_min, nonzero_max;  // inclusive box of the non-zero samples; min > max where there are none
  bool constant() const { return min == max; }
};
GridStats grid_stats(const Grid& grid);  // over all samples, the unstored zeros included

}  // namespace brume
