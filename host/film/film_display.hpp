// From linear radiance to what a screen is given: clamp((radiance · 2^exposure)^(1/2.2)).
#pragma once
#include <vector>

namespace brume {

// In [0,1]; NaN and negative radiance are 0, infinite radiance is 1. `exposure` in stops.
float film_display(float radiance, double exposure);
std::vector<float> film_display(const std::vector<float>& radiance, double exposure);

}  // namespace brume
