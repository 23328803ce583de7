// Reading the numbers of a shape; which they are: shared/shape.h.
#ifndef BRUME_SHAPES_SHAPE_CL
#define BRUME_SHAPES_SHAPE_CL
#include "lib/vec.cl"
#include "shared/shape.h"

static inline float3 shape_vec(const Shape* shape, int i) {
  return (float3)(shape->data[i], shape->data[i + 1], shape->data[i + 2]);
}

// Where a shape that emits is asked by a point: one place of those that may be seen from there.
typedef struct {
  float3 way;   // from the point to the place
  float solid;  // the solid angle that it stands for, as if it were alone: (area that may be seen) · cos / way²
} ShapePlace;

// `normal`: of any length and side.
static inline ShapePlace shape_place_of(float3 way, float3 normal, float area) {
  const float square = dot(way, way), length_normal = length(normal);
  ShapePlace place;
  place.way = way;
  place.solid = square > 0.0f && length_normal > 0.0f
                    ? area * fabs(dot(normal, way)) / (length_normal * square * sqrt(square))
                    : 0.0f;
  return place;
}

static inline Affine shape_affine(const Shape* shape) {
  Affine a;
  for (int i = 0; i < 12; ++i) a.m[i] = shape->data[i];
  return a;
}

#endif
