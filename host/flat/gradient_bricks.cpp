// Where the bricks of liquids lie, whose gradients a pass of the device computes (kernels/passes/presence_gradients.cl).
#include <set>

#include "flat/bricks.hpp"

namespace brume {

namespace {

constexpr GradientBrick NOWHERE{-1, 0, 0, 0};

// Bricks of one value lie in many places and have no gradients.
bool has_gradients(const FlatScene& scene, std::size_t brick) {
  return scene.brick_ranges[2 * brick] < scene.brick_ranges[2 * brick + 1];
}

}  // namespace

int gradient_bricks_append(const Medium& medium, std::size_t first_voxel, FlatScene& scene) {
  const std::size_t first = first_voxel / BRICK_VALUES, begin = scene.gradient_bricks.size();
  scene.gradient_bricks.resize(begin + scene.voxels.size() / BRICK_VALUES - first, NOWHERE);
  const glm::ivec3 bricks(medium.brick_nx, medium.brick_ny, medium.brick_nz), blocks = (bricks - 1) / BRICK_BLOCK + 1;
  std::set<std::int32_t> seen;  // blocks that are alike share their entries
  for (glm::ivec3 block(0); block.z < blocks.z; ++block.z)
    for (block.y = 0; block.y < blocks.y; ++block.y)
      for (block.x = 0; block.x < blocks.x; ++block.x) {
        if (!seen.insert(brick_block_entries(scene, medium, block)).second) continue;
        const glm::ivec3 lo = block * BRICK_BLOCK, hi = glm::min(lo + BRICK_BLOCK, bricks);
        for (glm::ivec3 b = lo; b.z < hi.z; ++b.z)
          for (b.y = lo.y; b.y < hi.y; ++b.y)
            for (b.x = lo.x; b.x < hi.x; ++b.x) {
              const std::int32_t entry = brick_entry(scene, medium, b);
              if (entry == BRICK_EMPTY || !has_gradients(scene, static_cast<std::size_t>(entry))) continue;
              scene.gradient_bricks[begin + static_cast<std::size_t>(entry) - first] = {
                  static_cast<int>(scene.media.size()), b.x, b.y, b.z};
            }
      }
  return static_cast<int>(begin) - static_cast<int>(first);
}

}  // namespace brume
