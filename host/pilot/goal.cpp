// See goal.hpp.
#include "pilot/goal.hpp"

#include <algorithm>

namespace brume {

std::array<double, 3> shown_by(const FilmPixel& pixel) {
  const double n = std::max(double(pixel.samples), 1.0);
  return {pixel.radiance.x / n, pixel.radiance.y / n, pixel.radiance.z / n};
}

double error_in(const WitnessError& error, int metric) {
  const double values[] = {error.rel_rmse, error.max_abs, error.display};
  static_assert(sizeof values / sizeof *values == METRIC_COUNT, "one per row of BRUME_ERROR_METRICS");
  return values[metric];
}

double error_at_most(const WitnessError& error, int metric) {
  constexpr double BEYOND = 1.5;  // the largest of some pixels is below that of all
  return metric == METRIC_REL_RMSE ? error.interval[1] : BEYOND * error_in(error, metric);
}

}  // namespace brume
