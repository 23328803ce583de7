// Phase functions; this file is only the dispatcher. Sign: the angle lies between directions of TRAVEL before and after
// scattering, so g > 0 scatters forward.
#ifndef BRUME_PHASE_PHASE_CL
#define BRUME_PHASE_PHASE_CL
#include "lib/options.cl"
#include "phase/henyey_greenstein.cl"
#include "phase/isotropic.cl"
#include "shared/phase.h"

// 1/sr; before and after are unit. A row without its function does not compile.
static inline float phase_eval(int phase, float g, float3 before, float3 after) {
#define ROW(id, name, takes_g, help) \
  if (USES_PHASE(id) && phase == PHASE_##id) return name##_eval(g, before, after);
  BRUME_PHASES(ROW)
#undef ROW
  return 0.0f;
}

#endif
