// Reading the numbers of a shape; which they are: shared/shape.h.
#ifndef BRUME_SHAPES_SHAPE_CL
#define BRUME_SHAPES_SHAPE_CL
#include "lib/vec.cl"
#include "shared/shape.h"

static inline float3 shape_vec(const Shape* shape, int i) {
  return (float3)(shape->data[i], shape->data[i + 1], shape->data[i + 2]);
}

static inline Affine shape_affine(const Shape* shape) {
  Affine a;
  for (int i = 0; i < 12; ++i) a.m[i] = shape->data[i];
  return a;
}

#endif
