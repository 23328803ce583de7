// Henyey-Greenstein and isotropic scattering.
#include "reference/phase.hpp"

#include <cmath>

#include "reference/vec.hpp"
#include "shared/phase.h"

namespace brume::reference {

double phase_eval(int phase, double g, double cos_theta) {
  if (phase == PHASE_ISOTROPIC) return 1 / (4 * PI);
  // 1 + g² - 2gc cancels near the peak; these two forms of it are sums of positive terms
  const double peak = 1 - std::abs(g);
  const double away = g > 0 ? 1 - cos_theta : 1 + cos_theta;
  const double base = peak * peak + 2 * std::abs(g) * away;
  return peak * (1 + std::abs(g)) / (4 * PI * base * std::sqrt(base));
}

}  // namespace brume::reference
