// Quadratic equations of sphere and cylinder.
#ifndef BRUME_SHAPES_QUADRATIC_CL
#define BRUME_SHAPES_QUADRATIC_CL
#include "lib/vec.cl"

// Both roots of a t² + 2 b t + c = 0 without cancellation; 0 when there are none. a > 0.
static inline int quadratic_roots(float a, float b, float c, float discriminant, float* t0, float* t1) {
  if (!(discriminant >= 0.0f)) return 0;
  const float root = sqrt(discriminant);
  const float q = -(b + copysign(root, b));
  const float r0 = q / a;
  const float r1 = q == 0.0f ? 0.0f : c / q;
  *t0 = fmin(r0, r1);
  *t1 = fmax(r0, r1);
  return 1;
}

#endif
