// Phase functions. The sign convention is stated once, in kernels/phase/phase.cl: cos θ between
// directions of TRAVEL before and after scattering, so g > 0 is forward.
#ifndef BRUME_SHARED_PHASE_H
#define BRUME_SHARED_PHASE_H
#include "shared/platform.h"

// ROW(ID, name; kernels: NAME_eval, takes g, help)
#define BRUME_PHASES(ROW)                \
  ROW(ISOTROPIC, isotropic, 0, "1/(4π)") \
  ROW(HENYEY_GREENSTEIN, henyey_greenstein, 1, "(1-g²)/(4π(1+g²-2g cosθ)^1.5), -1 < g < 1, g > 0 forward")

BRUME_SHARED_BEGIN
enum PhaseType {
#define ROW(id, name, takes_g, help) PHASE_##id,
  BRUME_PHASES(ROW)
#undef ROW
      PHASE_COUNT
};
BRUME_SHARED_END
#endif
