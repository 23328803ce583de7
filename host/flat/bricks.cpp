// Grid → bricks. Nearest: cell c is voxel c. Trilinear: samples are padded by one on each side (by the border rule), so that padded
// sample s = i + 1 sits at cell-space position s, which is lattice + 0.5.
#include <algorithm>
#include <glm/vector_relational.hpp>
#include <map>
#include <optional>

#include "base/error.hpp"
#include "flat/flatten_parts.hpp"

namespace brume {

namespace {

// 32-bit offsets into the voxels: kernels gather with int lanes.
constexpr std::int64_t VOXELS_MAX = 0x7fffffff;

// Sample s of the (padded) lattice.
float padded_sample(const Grid& grid, ivec3 s, int pad) {
  const ivec3 i = s - pad, last = grid.size() - 1;
  const ivec3 inside = glm::clamp(i, ivec3(0), last);
  if (grid.border == Border::ZERO && pad > 0 && inside != i) return 0.0f;
  return grid.at(inside);
}

struct Brick {
  std::array<float, BRICK_VALUES> samples;
  float min, max;
};

// Samples of the brick at brick coordinates b. min and max are over the samples that lookups of its cells read.
Brick brick_cut(const Grid& grid, ivec3 b, int pad) {
  Brick brick;
  brick.min = INFINITY;
  brick.max = -INFINITY;
  const int read = pad > 0 ? BRICK_SAMPLES : BRICK_CELLS;
  float* out = brick.samples.data();
  for (int z = 0; z < BRICK_SAMPLES; ++z)
    for (int y = 0; y < BRICK_SAMPLES; ++y)
      for (int x = 0; x < BRICK_SAMPLES; ++x) {
        const float value = padded_sample(grid, b * BRICK_CELLS + ivec3(x, y, z), pad);
        *out++ = value;
        if (x >= read || y >= read || z >= read) continue;
        brick.min = std::min(brick.min, value);
        brick.max = std::max(brick.max, value);
      }
  return brick;
}

Brick brick_of(float value) {
  Brick brick{{}, value, value};
  brick.samples.fill(value);
  return brick;
}

// The one value of all samples that the brick reads, where the blocks of the grid tell it.
std::optional<float> brick_surely_one(const Grid& grid, ivec3 b, int pad) {
  const ivec3 last = grid.size() - 1, begin = b * BRICK_CELLS - pad, end = begin + (BRICK_SAMPLES - 1);
  const ivec3 lo = glm::clamp(begin, ivec3(0), last) / GRID_BLOCK, hi = glm::clamp(end, ivec3(0), last) / GRID_BLOCK;
  const auto value_of = [&](ivec3 block) { return grid.block_empty(block) ? 0.0f : *grid.block(block); };
  const float value = value_of(lo);
  const bool fades =
      grid.border == Border::ZERO && pad > 0 && (begin != glm::max(begin, ivec3(0)) || end != glm::min(end, last));
  if (value != 0 && fades) return std::nullopt;
  for (int z = lo.z; z <= hi.z; ++z)
    for (int y = lo.y; y <= hi.y; ++y)
      for (int x = lo.x; x <= hi.x; ++x)
        if (!grid.block_uniform({x, y, z}) || value_of({x, y, z}) != value) return std::nullopt;
  return value;
}

// Stores the brick's samples and returns its number; bricks of one constant value share one.
std::int32_t brick_store(const Brick& brick, std::map<float, std::int32_t>& constants, FlatScene& scene,
                         const std::string& source) {
  const bool constant = brick.min == brick.max;
  const auto number = static_cast<std::int32_t>(scene.voxels.size() / BRICK_VALUES);
  if (constant) {
    const auto known = constants.find(brick.min);
    if (known != constants.end()) return known->second;
    constants[brick.min] = number;
  }
  if (static_cast<std::int64_t>(scene.voxels.size()) + BRICK_VALUES > VOXELS_MAX)
    throw InputError(source + ": more than " + std::to_string(VOXELS_MAX / BRICK_VALUES) +
                     " bricks of 8x8x8 cells hold values; allowed are that many (8 GiB)");
  scene.voxels.insert(scene.voxels.end(), brick.samples.begin(), brick.samples.end());
  return number;
}

// The cells in which the density is not 0: what lies outside of them need not be crossed, lit or given a light grid.
struct Occupied {
  ivec3 lo{0x7fffffff}, hi{-1};  // cells [lo, hi)

  // Sample s reaches the cells from s - pad to s.
  void add(const Brick& brick, ivec3 first, int pad) {
    const int read = pad > 0 ? BRICK_SAMPLES : BRICK_CELLS;
    if (glm::all(glm::greaterThanEqual(first, lo)) && glm::all(glm::lessThanEqual(first + read, hi))) return;
    for (int z = 0; z < read; ++z)
      for (int y = 0; y < read; ++y)
        for (int x = 0; x < read; ++x) {
          if (brick.samples[(z * BRICK_SAMPLES + y) * BRICK_SAMPLES + x] == 0) continue;
          const ivec3 sample = first + ivec3(x, y, z);
          lo = glm::min(lo, sample - pad);
          hi = glm::max(hi, sample + 1);
        }
  }
};

}  // namespace

void bricks_append(const Grid& grid, Medium& medium, FlatScene& scene) {
  const int pad = medium.interpolation == INTERPOLATION_TRILINEAR ? 1 : 0;
  const ivec3 cells = grid.size() + pad;
  const ivec3 bricks = (cells + BRICK_CELLS - 1) / BRICK_CELLS;
  const double lo = pad > 0 && grid.border == Border::CLAMP ? 0.5 : 0.0;
  medium.lo = packed(dvec3(lo));
  medium.hi = packed(dvec3(cells) - lo);
  medium.cells_x = cells.x;
  medium.cells_y = cells.y;
  medium.cells_z = cells.z;
  medium.brick_nx = bricks.x;
  medium.brick_ny = bricks.y;
  medium.brick_nz = bricks.z;
  medium.brick_offset = static_cast<int>(scene.bricks.size());
  if (static_cast<std::int64_t>(bricks.x) * bricks.y * bricks.z + medium.brick_offset > 0x7fffffff)
    throw InputError(grid.source + ": " + std::to_string(bricks.x) + "x" + std::to_string(bricks.y) + "x" +
                     std::to_string(bricks.z) + " bricks are more than 2^31");
  std::map<float, std::int32_t> constants;
  Occupied occupied;
  for (int z = 0; z < bricks.z; ++z)
    for (int y = 0; y < bricks.y; ++y)
      for (int x = 0; x < bricks.x; ++x) {
        const ivec3 b(x, y, z);
        std::int32_t entry = BRICK_EMPTY;
        float min = 0, max = 0;
        const std::optional<float> one = brick_surely_one(grid, b, pad);
        if (one != 0.0f) {
          const Brick brick = one ? brick_of(*one) : brick_cut(grid, b, pad);
          min = brick.min;
          max = brick.max;
          if (max > 0) {
            entry = brick_store(brick, constants, scene, grid.source);
            occupied.add(brick, b * BRICK_CELLS, pad);
          }
        }
        scene.bricks.push_back(entry);
        scene.brick_ranges.insert(scene.brick_ranges.end(), {min, max});
      }
  if (occupied.hi.x < 0) return;
  medium.lo = packed(glm::max(dvec3(lo), dvec3(occupied.lo)));
  medium.hi = packed(glm::min(dvec3(cells) - lo, dvec3(occupied.hi)));
}

}  // namespace brume
