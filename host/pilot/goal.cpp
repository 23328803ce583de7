// See goal.hpp.
#include "pilot/goal.hpp"

namespace brume {

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
