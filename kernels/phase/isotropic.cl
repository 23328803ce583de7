// 1/(4π) in all directions.
#ifndef BRUME_PHASE_ISOTROPIC_CL
#define BRUME_PHASE_ISOTROPIC_CL

static inline float isotropic_eval(float g, float3 before, float3 after) {
  (void)g;
  (void)before;
  (void)after;
  return 0.0795774715459477f;
}

#endif
