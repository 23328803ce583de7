// In double: one pow per channel is nothing beside a rendering, and the 8-bit codes then do not depend on the float
// library.
#include "film/film_display.hpp"

#include <cmath>
#include <iterator>

namespace brume {

namespace {

double gamma_encode(double light) { return std::pow(light, 1 / 2.2); }

// [IEC 61966-2-1]
double srgb_encode(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

constexpr double (*ENCODE[])(double) = {gamma_encode, srgb_encode};  // in the order of BRUME_TRANSFERS
static_assert(std::size(ENCODE) == TRANSFER_COUNT);

}  // namespace

float film_display(float radiance, double exposure, int transfer) {
  if (!(radiance > 0)) return 0;  // NaN too
  return static_cast<float>(std::fmin(ENCODE[transfer](double(radiance) * std::exp2(exposure)), 1.0));
}

std::vector<float> film_display(const std::vector<float>& radiance, double exposure, int transfer) {
  std::vector<float> display;
  display.reserve(radiance.size());
  for (float value : radiance) display.push_back(film_display(value, exposure, transfer));
  return display;
}

}  // namespace brume
