// Henyey–Greenstein [Henyey41].
#ifndef BRUME_PHASE_HENYEY_GREENSTEIN_CL
#define BRUME_PHASE_HENYEY_GREENSTEIN_CL

// 1 + g² - 2 g c = (1-|g|)² + 2 |g| (1 ∓ c), and 1 - a·b = |a-b|²/2 for unit vectors: nothing cancels, also for |g|
// near 1 and light that goes on almost straight.
static inline float henyey_greenstein_eval(float g, float3 before, float3 after) {
  const float h = fabs(g);
  const float3 turn = g < 0.0f ? before + after : before - after;
  const float one_minus = 1.0f - h;
  const float a = one_minus * one_minus + h * dot(turn, turn);
  return 0.0795774715459477f * one_minus * (1.0f + h) / (a * sqrt(a));
}

#endif
