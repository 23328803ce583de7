// Densities and coefficients in units in which float holds them.
#include <algorithm>
#include <cmath>

#include "flat/flatten_parts.hpp"

namespace brume {

namespace {

// Only density times coefficient means anything. Densities whose largest is no more than this away from 1 stay; others
// are scaled by a power of two, so that float (and half) hold them and what is made of them.
constexpr double DENSITY_RANGE = 1024;

double density_unit(double largest) {
  const bool fits = largest == 0 || (largest <= DENSITY_RANGE && largest >= 1 / DENSITY_RANGE);
  return fits ? 1 : std::exp2(std::floor(std::log2(largest)));
}

// What absorbs more than this per flat unit is opaque over any length; no more than that is kept, so that τ stays
// within float.
constexpr double OPAQUE = 1e30;

}  // namespace

float density_max(const Medium& medium, std::size_t first_voxel, const FlatScene& scene) {
  if (medium.is_constant) return medium.constant_density;
  float max = 0;
  for (std::size_t i = 2 * (first_voxel / BRICK_VALUES) + 1; i < scene.brick_ranges.size(); i += 2)
    max = std::max(max, scene.brick_ranges[i]);
  return max;
}

double densities_scale(Medium& medium, std::size_t first_voxel, FlatScene& scene) {
  const double unit = density_unit(density_max(medium, first_voxel, scene));
  if (unit == 1) return 1;
  const auto scale = [unit](float& value) { value = static_cast<float>(value / unit); };
  scale(medium.constant_density);
  if (medium.is_constant) return unit;
  const auto first_range = static_cast<std::ptrdiff_t>(2 * (first_voxel / BRICK_VALUES));
  std::for_each(scene.voxels.begin() + static_cast<std::ptrdiff_t>(first_voxel), scene.voxels.end(), scale);
  std::for_each(scene.brick_ranges.begin() + first_range, scene.brick_ranges.end(), scale);
  return unit;
}

void coefficients_flatten(const MediumDesc& desc, double per, MediumBody& medium) {
  dvec3 absorbed = desc.sigma_a * per, scattered = desc.sigma_s * per, emitted = desc.emission * per;
  for (int c = 0; c < 3; ++c) {
    const double kept =
        OPAQUE / std::max(absorbed[c] + scattered[c], OPAQUE);  // of all three: what it sends stays the same
    absorbed[c] *= kept;
    scattered[c] *= kept;
    emitted[c] *= kept;
  }
  medium.sigma_a = packed(absorbed);
  medium.sigma_s = packed(scattered);
  medium.emission = packed(emitted);
}

}  // namespace brume
