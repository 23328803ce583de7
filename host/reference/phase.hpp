// Phase functions of the reference renderer.
#pragma once

namespace brume::reference {

// Value in 1/sr of phase function `phase` (PhaseType); integrates to 1 over the sphere. cos_theta is between directions
// of travel before and after, so g > 0 is forward; -1 < g < 1.
double phase_eval(int phase, double g, double cos_theta);

}  // namespace brume::reference
