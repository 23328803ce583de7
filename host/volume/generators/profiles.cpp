// Densities with a closed form along y; sample j sits at y = (j + 0.5) / ny.
#include <cfloat>
#include <cmath>

#include "base/error.hpp"
#include "base/number_text.hpp"
#include "volume/generators/generators.hpp"

namespace brume {

Grid density_constant(const DensitySpec& spec) {
  if (!(spec.value >= 0 && spec.value <= FLT_MAX))
    throw InputError("density 'constant': value: expected a finite number >= 0, got " + number_text(spec.value));
  Grid grid = grid_empty(spec);
  grid.fill(ivec3(0), grid.size() - 1, static_cast<float>(spec.value));
  return grid;
}

Grid density_linear(const DensitySpec& spec) {
  return grid_generate(spec, [&](ivec3 i) { return 1 - (i.y + 0.5) / spec.resolution.y; });
}

Grid density_exponential(const DensitySpec& spec) {
  return grid_generate(spec, [&](ivec3 i) { return std::exp(-(i.y + 0.5) / spec.resolution.y); });
}

}  // namespace brume
