// In double: one pow per channel is nothing beside a rendering, and the 8-bit codes then do not depend on the float
// library.
#include "film/film_display.hpp"

#include <cmath>

namespace brume {

float film_display(float radiance, double exposure) {
  if (!(radiance > 0)) return 0;  // NaN too
  return static_cast<float>(std::fmin(std::pow(double(radiance) * std::exp2(exposure), 1 / 2.2), 1.0));
}

std::vector<float> film_display(const std::vector<float>& radiance, double exposure) {
  std::vector<float> display;
  display.reserve(radiance.size());
  for (float value : radiance) display.push_back(film_display(value, exposure));
  return display;
}

}  // namespace brume
