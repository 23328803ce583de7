// The exact picture held against pixels in double precision: what error it has itself.
#pragma once
#include "chart/point.hpp"
#include "flat/render_plan.hpp"
#include "image/image.hpp"

namespace brume {

struct WitnessOptions {
  int pixels = 256;
  double seconds = 30;  // after which no further pixel is begun, once there are WITNESSES_LEAST
  int order = 3;        // Gauss-Legendre points between two faces of cells
};
inline constexpr int WITNESSES_LEAST = 16;

// Places of at most `count` pixels, one anywhere in each tile of the box x0, y0, x1, y1, in random order: any first
// part of them is spread over all of it. All pixels where there are no more.
std::vector<std::array<int, 2>> witness_places(const std::array<int, 4>& box, int count, unsigned seed);

// What the reference says of some pixels.
struct Witnesses {
  std::vector<std::array<int, 2>> places;
  std::vector<std::array<double, 3>> radiance;  // their means over samples
  int order = 0;
};
// By single scattering integrated between all faces of cells. Throws Interrupted.
Witnesses witnesses_ask(const PlannedScene& scene, const WitnessOptions& options);

// Holds `picture`, the crop of `frame`, against them and fills in what `exact` says of witnesses.
void witnesses_compare(const Witnesses& witnesses, const Frame& frame, const Image& picture, ChartExact& exact);

}  // namespace brume
