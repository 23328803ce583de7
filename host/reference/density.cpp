// Density lookups in bricks. See medium.hpp.
#include <glm/common.hpp>

#include "reference/medium.hpp"

namespace brume::reference {
namespace {

static_assert(INTERPOLATION_COUNT == 2, "density_in_cell knows all");

// Samples of one cell's brick, or nullptr where the brick is empty.
const float* brick_of(const PlannedScene& scene, const Medium& medium, const ivec3& cell) {
  const int entry = brick_number(scene, medium, cell);
  return entry == BRICK_EMPTY ? nullptr : &scene.voxels[static_cast<std::size_t>(entry) * BRICK_VALUES];
}

}  // namespace

ivec3 cell_at(const Medium& medium, const dvec3& p) {
  const dvec3 first = glm::max(dvec3(0), glm::floor(vec_promote(medium.lo)));
  const dvec3 cells(medium.cells_x, medium.cells_y, medium.cells_z);
  const dvec3 last = glm::max(first, glm::min(cells, glm::ceil(vec_promote(medium.hi))) - 1.0);
  return ivec3(glm::clamp(glm::floor(p), first, last));
}

int brick_number(const PlannedScene& scene, const Medium& medium, const ivec3& cell) {
  const auto place = [](const ivec3& i, int nx, int ny) {
    return (static_cast<std::size_t>(i.z) * static_cast<std::size_t>(ny) + static_cast<std::size_t>(i.y)) *
               static_cast<std::size_t>(nx) +
           static_cast<std::size_t>(i.x);
  };
  const auto blocks = [](int bricks) { return (bricks - 1) / BRICK_BLOCK + 1; };
  const ivec3 brick = cell / BRICK_CELLS;
  const std::size_t block = static_cast<std::size_t>(medium.brick_offset) +
                            place(brick / BRICK_BLOCK, blocks(medium.brick_nx), blocks(medium.brick_ny));
  return scene
      .bricks[static_cast<std::size_t>(scene.bricks[block]) + place(brick % BRICK_BLOCK, BRICK_BLOCK, BRICK_BLOCK)];
}

double density_in_cell(const PlannedScene& scene, const Medium& medium, const ivec3& cell, const dvec3& p) {
  if (medium.is_constant) return medium.constant_density;
  const float* samples = brick_of(scene, medium, cell);
  if (!samples) return 0;
  const ivec3 i = cell % BRICK_CELLS;
  const float* corner = samples + (i.z * BRICK_SAMPLES + i.y) * BRICK_SAMPLES + i.x;
  if (medium.interpolation == INTERPOLATION_NEAREST) return corner[0];

  const dvec3 w = p - dvec3(cell);
  const auto along_x = [&](int dy, int dz) {
    const float* s = corner + (dz * BRICK_SAMPLES + dy) * BRICK_SAMPLES;
    return s[0] * (1 - w.x) + s[1] * w.x;
  };
  const double front = along_x(0, 0) * (1 - w.y) + along_x(1, 0) * w.y;
  const double back = along_x(0, 1) * (1 - w.y) + along_x(1, 1) * w.y;
  return front * (1 - w.z) + back * w.z;
}

double density_at(const PlannedScene& scene, const Medium& medium, const dvec3& p) {
  const dvec3 inside = glm::clamp(p, vec_promote(medium.lo), vec_promote(medium.hi));
  return density_in_cell(scene, medium, cell_at(medium, inside), inside);
}

}  // namespace brume::reference
