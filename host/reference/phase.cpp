// Henyey-Greenstein and isotropic scattering.
#include "reference/phase.hpp"

#include <cmath>
#include <iterator>

#include "reference/vec.hpp"
#include "shared/phase.h"

namespace brume::reference {

namespace {

double isotropic(double, double) { return 1 / (4 * PI); }

double henyey_greenstein(double g, double cos_theta) {
  // 1 + g² - 2gc cancels near the peak; these two forms of it are sums of positive terms
  const double peak = 1 - std::abs(g);
  const double away = g > 0 ? 1 - cos_theta : 1 + cos_theta;
  const double base = peak * peak + 2 * std::abs(g) * away;
  return peak * (1 + std::abs(g)) / (4 * PI * base * std::sqrt(base));
}

using PhaseEval = double (*)(double g, double cos_theta);
constexpr PhaseEval PHASES[] = {isotropic, henyey_greenstein};
static_assert(std::size(PHASES) == PHASE_COUNT, "one row per PhaseType, in its order");

}  // namespace

double phase_eval(int phase, double g, double cos_theta) { return PHASES[phase](g, cos_theta); }

}  // namespace brume::reference
