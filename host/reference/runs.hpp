// Light of `adaptive` (PICTURE, Runs): which points of a view ray ask for light, and what the others take it to be.
#pragma once
#include <vector>

#include "reference/scatter.hpp"

namespace brume::reference {

struct RunPoint {
  double t;
  dvec3 gain;           // ∫ρT that it stands for
  RandomStream random;  // of its segment
  RandomStream places;  // of the ray, for lights with an area
};

inline constexpr std::size_t RUN_POINTS = 64;

// Light, summed over the channels, of a ray so far: it grows with every run.
struct RunsBefore {
  double seen = 0;   // that the ray got
  double faint = 0;  // of lights that were asked nowhere, if nothing were in the way
};

// What medium `index`, of which the ray passes `inside`, scatters to its origin from a run of points.
dvec3 run_radiance(const Context& context, int index, const RayD& ray, const std::vector<RunPoint>& points,
                   double inside, RunsBefore& before, Scattered& result);

}  // namespace brume::reference
