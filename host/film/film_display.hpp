// From linear radiance to what a screen is given: a curve of kernels/shared/transfer.h over radiance · 2^exposure, cut
// at 1.
#pragma once
#include <vector>

#include "shared/transfer.h"

namespace brume {

// In [0,1]; NaN and negative radiance are 0, infinite radiance is 1. `exposure` in stops.
float film_display(float radiance, double exposure, int transfer = TRANSFER_GAMMA);
std::vector<float> film_display(const std::vector<float>& radiance, double exposure, int transfer = TRANSFER_GAMMA);

}  // namespace brume
