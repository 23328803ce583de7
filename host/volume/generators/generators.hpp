// The density generators behind the table in density_source.cpp, and the loop that they share. Not for use elsewhere.
#pragma once
#include "volume/density_source.hpp"

namespace brume {

Grid density_constant(const DensitySpec& spec);
Grid density_linear(const DensitySpec& spec);
Grid density_exponential(const DensitySpec& spec);
Grid density_perlin(const DensitySpec& spec);
Grid density_sphere(const DensitySpec& spec);

// A grid of spec.resolution whose sample i is value(i). Refuses resolutions whose samples would not fit.
template <class Value>
Grid grid_generate(const DensitySpec& spec, Value value) {
  const ivec3 size = spec.resolution;
  grid_expect_fits("density '" + spec.type + "': resolution", size, double(size.x) * double(size.y) * double(size.z));
  Grid grid(size);
  grid.source = spec.type;
  for (ivec3 i(0); i.z < size.z; ++i.z)
    for (i.y = 0; i.y < size.y; ++i.y)
      for (i.x = 0; i.x < size.x; ++i.x) grid.set(i, static_cast<float>(value(i)));
  return grid;
}

}  // namespace brume
