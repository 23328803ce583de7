// A grid with half as many samples along each axis, each the mean of those that it stands for.
#pragma once
#include "volume/grid.hpp"

namespace brume {

// The integral of the density stays as it is, and so does where the grid ends (Border::CLAMP: n samples become n / 2,
// rounded up, that share its length evenly) or whence it fades (Border::ZERO: pairs from the first sample on). Costs
// what is stored: what is one value, or empty, stays so. Throws what Grid throws.
Grid grid_halved(const Grid& fine);

}  // namespace brume
