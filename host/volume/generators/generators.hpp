// The density generators behind the table in density_source.cpp, and the loop that they share. Not for use elsewhere.
#pragma once
#include "volume/density_source.hpp"

namespace brume {

Grid density_constant(const DensitySpec& spec);
Grid density_linear(const DensitySpec& spec);
Grid density_exponential(const DensitySpec& spec);
Grid density_perlin(const DensitySpec& spec);
Grid density_sphere(const DensitySpec& spec);
Grid density_ball(const DensitySpec& spec);

// A grid of spec.resolution. Refuses resolutions whose samples would not fit.
inline Grid grid_empty(const DensitySpec& spec) {
  const ivec3 size = spec.resolution;
  grid_expect_fits("density '" + spec.type + "': resolution", size, double(size.x) * double(size.y) * double(size.z));
  Grid grid(size);
  grid.source = spec.type;
  return grid;
}

// The same whose sample i is value(i).
template <class Value>
Grid grid_generate(const DensitySpec& spec, Value value) {
  Grid grid = grid_empty(spec);
  for (ivec3 i(0); i.z < grid.size().z; ++i.z)
    for (i.y = 0; i.y < grid.size().y; ++i.y)
      for (i.x = 0; i.x < grid.size().x; ++i.x) grid.set(i, static_cast<float>(value(i)));
  return grid;
}

}  // namespace brume
