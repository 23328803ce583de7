// Which cells of each brick an isosurface may cross.
#include <algorithm>
#include <cmath>

#include "flat/flatten_parts.hpp"

namespace brume {

namespace {

// How far a voxel in fewer bytes may be from the one that is given, and more (render.storage).
float storage_error(float min, float max) { return (max - min) / 500 + std::max(std::abs(min), std::abs(max)) / 1000; }

void brick_mask(const float* samples, float low, float high, uint* mask) {
  constexpr int ROW = BRICK_SAMPLES, LAYER = BRICK_SAMPLES * BRICK_SAMPLES;
  for (int cell = 0; cell < BRICK_CELLS * BRICK_CELLS * BRICK_CELLS; ++cell) {
    const float* s = samples + (cell >> 6) * LAYER + (cell >> 3 & 7) * ROW + (cell & 7);
    const auto [least, most] =
        std::minmax({s[0], s[1], s[ROW], s[ROW + 1], s[LAYER], s[LAYER + 1], s[LAYER + ROW], s[LAYER + ROW + 1]});
    if (least <= high && most >= low) mask[cell >> 5] |= 1u << (cell & 31);
  }
}

}  // namespace

int iso_masks_append(std::size_t first, std::size_t bricks, float iso, FlatScene& scene) {
  const std::size_t begin = scene.iso_masks.size();
  scene.iso_masks.resize(begin + bricks * ISO_MASK_WORDS);
  for (std::size_t i = 0; i < bricks; ++i) {
    const float min = scene.brick_ranges[2 * (first + i)], max = scene.brick_ranges[2 * (first + i) + 1];
    const float off = storage_error(min, max);
    if (min <= iso + off && max >= iso - off)
      brick_mask(&scene.voxels[(first + i) * BRICK_VALUES], iso - off, iso + off,
                 &scene.iso_masks[begin + i * ISO_MASK_WORDS]);
  }
  return static_cast<int>(begin) - static_cast<int>(first * ISO_MASK_WORDS);
}

}  // namespace brume
