// Phase functions; this file is only the dispatcher. Sign: the angle lies between directions of TRAVEL before and after
// scattering, so g > 0 scatters forward.
#ifndef BRUME_PHASE_PHASE_CL
#define BRUME_PHASE_PHASE_CL
#include "lib/options.cl"
#include "phase/henyey_greenstein.cl"
#include "phase/isotropic.cl"
#include "shared/phase.h"

// 1/sr; before and after are unit.
static inline float phase_eval(int phase, float g, float3 before, float3 after) {
  if (USES_PHASE(HENYEY_GREENSTEIN) && phase == PHASE_HENYEY_GREENSTEIN)
    return henyey_greenstein_eval(g, before, after);
  return isotropic_eval();
}

#endif
