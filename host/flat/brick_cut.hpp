// The samples of one brick out of a grid.
#pragma once
#include <array>

#include "shared/medium.h"
#include "volume/grid.hpp"

namespace brume {

using BrickSamples = std::array<float, BRICK_VALUES>;

struct Brick {
  BrickSamples samples;
  float min, max;  // over the samples that lookups of its cells read
};

// Brick b, padded by `pad` samples (0 or 1) on each side by the grid's border rule; what no lookup reads repeats the
// last.
Brick brick_cut(const Grid& grid, ivec3 b, int pad);

}  // namespace brume
