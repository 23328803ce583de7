// A scalar field on a regular lattice, stored sparsely in blocks of 8³ samples: what files and generators make and what
// flatten cuts into bricks. Knows nothing of coefficients, cameras or kernels.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <glm/ext/vector_int3_sized.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace brume {

using glm::dmat4;
using glm::dvec3;
using glm::ivec3;

inline constexpr int GRID_BLOCK = 8;                         // samples along a side of a block
inline constexpr std::uint64_t GRID_BYTES_MAX = 8ull << 30;  // of one grid; larger ones are refused

// What lies beyond the outermost samples.
//   CLAMP: samples at (i+0.5)/n of the bounds; within half a voxel of the border the outermost sample goes on (generators, raw).
//   ZERO:  samples at integer index; everything outside is 0, so trilinear fades over one voxel (OpenVDB).
enum class Border { CLAMP, ZERO };

class Grid {
 public:
  // Every size >= 1, all samples 0. Throws InputError for other sizes and for more blocks than GRID_BYTES_MAX can index.
  explicit Grid(ivec3 size);

  ivec3 size() const { return size_; }
  float at(ivec3 i) const;         // 0 <= i < size
  void set(ivec3 i, float value);  // stores a block on its first non-zero value; InputError beyond GRID_BYTES_MAX
  // The same value in the box lo ... hi (inclusive, within the grid). Whole blocks of one value are stored once.
  void fill(ivec3 lo, ivec3 hi, float value);
  std::size_t stored_bytes() const { return pool_.size() * sizeof(Block) + table_.size() * sizeof(std::int32_t); }

  // Block b holds samples 8b ... 8b+7 of each axis, x fastest, then y, z; those beyond the grid are 0. 0 <= b < blocks.
  ivec3 blocks() const { return blocks_; }
  bool block_empty(ivec3 b) const { return table_[table_index(b)] < 0; }  // all 0 and not stored
  const float* block(ivec3 b) const;                                      // its 512 samples, nullptr where empty
  bool block_uniform(ivec3 b) const;  // stored by fill() as one value throughout, or empty

  Border border = Border::CLAMP;
  // World position of lattice coordinates: sample i sits at world_from_lattice * (i + 0.5, i + 0.5, i + 0.5). In lattice
  // coordinates voxel i spans [i, i+1), so CLAMP grids fill [0, size] and ZERO grids reach half a voxel further when trilinear.
  dmat4 world_from_lattice{1.0};
  std::string name;                // of the grid within its file
  std::string source;              // file or generator, for messages and info
  std::vector<std::string> notes;  // what a user should be told: cleaned voxels, ...

 private:
  using Block = std::array<float, GRID_BLOCK * GRID_BLOCK * GRID_BLOCK>;
  std::size_t table_index(ivec3 b) const {
    return (static_cast<std::size_t>(b.z) * static_cast<std::size_t>(blocks_.y) + static_cast<std::size_t>(b.y)) *
               static_cast<std::size_t>(blocks_.x) +
           static_cast<std::size_t>(b.x);
  }
  static std::size_t sample_index(ivec3 i) {
    return static_cast<std::size_t>(((i.z & 7) << 6) | ((i.y & 7) << 3) | (i.x & 7));
  }
  std::int32_t block_store();
  std::int32_t block_uniform_of(float value);
  void block_own(std::int32_t& number);  // a copy where it is shared

  ivec3 size_, blocks_;
  std::vector<std::int32_t> table_;  // -1 or number of a block in pool_
  std::deque<Block> pool_;           // grows without moving what it holds
  std::vector<bool> shared_;         // per block of the pool: one of uniform_
  std::map<float, std::int32_t> uniform_;
};

inline float Grid::at(ivec3 i) const {
  const std::int32_t number = table_[table_index(i >> 3)];
  return number < 0 ? 0.0f : pool_[static_cast<std::size_t>(number)][sample_index(i)];
}

// Calls visit(i, value) for every sample of every stored block, block by block, x fastest within each. `visit` may set
// samples of stored blocks.
template <class Visit>
void grid_visit_stored(const Grid& grid, Visit visit) {
  const ivec3 blocks = grid.blocks(), size = grid.size();
  for (ivec3 b(0); b.z < blocks.z; ++b.z)
    for (b.y = 0; b.y < blocks.y; ++b.y)
      for (b.x = 0; b.x < blocks.x; ++b.x) {
        const float* samples = grid.block(b);
        if (!samples) continue;
        const ivec3 lo = b * GRID_BLOCK, n(std::min(GRID_BLOCK, size.x - lo.x), std::min(GRID_BLOCK, size.y - lo.y),
                                           std::min(GRID_BLOCK, size.z - lo.z));
        for (int z = 0; z < n.z; ++z)
          for (int y = 0; y < n.y; ++y)
            for (int x = 0; x < n.x; ++x) visit(lo + ivec3(x, y, z), samples[(z * GRID_BLOCK + y) * GRID_BLOCK + x]);
      }
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
