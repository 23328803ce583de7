// Transmittance methods: how ∫ρ dt along a ray is found and into which segments in-scattering is cut.
// Every method is a placement (where segments begin and end) and a rule (∫ρ over one segment).
#ifndef BRUME_SHARED_METHOD_H
#define BRUME_SHARED_METHOD_H
#include "shared/platform.h"

#define FITS_NEAREST 1
#define FITS_TRILINEAR 2
#define FITS_CONSTANT 4

// What a method draws random numbers for.
#define DRAWS_NOTHING 0
#define DRAWS_PLACES 1      // where in each step to sample
#define DRAWS_COLLISIONS 2  // where to collide: right in the mean for any density

// Ratio and residual ratio tracking ask for light at a tentative collision with TRACK_LIGHTS times the probability that it is real
// (at most 1): a brick with one hot voxel has a million collisions that hardly scatter.
#define TRACK_LIGHTS 4.0f

// ROW(ID, name, fits, has a step, draws, help)
#define BRUME_METHODS(ROW)                                                                                      \
  ROW(DDA_NEAREST, "dda_nearest", FITS_NEAREST, 0, DRAWS_NOTHING, "voxel by voxel; exact for nearest")          \
  ROW(DDA_GAUSS2, "dda_gauss2", FITS_TRILINEAR, 0, DRAWS_NOTHING,                                               \
      "cell by cell, 2-point Gauss-Legendre; exact for trilinear")                                              \
  ROW(DDA_MIDPOINT, "dda_midpoint", FITS_TRILINEAR, 0, DRAWS_NOTHING, "cell by cell, one sample in the middle") \
  ROW(MARCH_REGULAR, "march_regular", FITS_NEAREST | FITS_TRILINEAR, 1, DRAWS_NOTHING,                          \
      "equal steps, one sample where each begins")                                                              \
  ROW(MARCH_REGULAR_JITTER, "march_regular_jitter", FITS_NEAREST | FITS_TRILINEAR, 1, DRAWS_PLACES,             \
      "equal steps, one sample anywhere in each")                                                               \
  ROW(MARCH_MIDPOINT, "march_midpoint", FITS_NEAREST | FITS_TRILINEAR, 1, DRAWS_NOTHING,                        \
      "equal steps, one sample in the middle of each")                                                          \
  ROW(MARCH_MIDPOINT_JITTER, "march_midpoint_jitter", FITS_NEAREST | FITS_TRILINEAR, 1, DRAWS_PLACES,           \
      "equal steps, one sample anywhere in the middle half of each")                                            \
  ROW(DELTA_TRACKING, "delta_tracking", FITS_NEAREST | FITS_TRILINEAR, 0, DRAWS_COLLISIONS,                     \
      "to the first collision; unbiased, noisy: transmittance is 0 or 1")                                       \
  ROW(RATIO_TRACKING, "ratio_tracking", FITS_NEAREST | FITS_TRILINEAR, 0, DRAWS_COLLISIONS,                     \
      "through all collisions, weakened by each; unbiased")                                                     \
  ROW(RESIDUAL_RATIO, "residual_ratio", FITS_NEAREST | FITS_TRILINEAR, 0, DRAWS_COLLISIONS,                     \
      "ratio tracking of what exceeds each brick's smallest density; unbiased")                                 \
  ROW(HOMOGENEOUS, "homogeneous", FITS_CONSTANT, 1, DRAWS_NOTHING,                                              \
      "closed form for a constant density (also cut to a sphere); equal steps for the light")

// How the light scattered along a segment is summed.
#define BRUME_IN_SCATTERINGS(ROW)                                                           \
  ROW(SEGMENT, "segment", "exact for constant light over each segment: stable at any step") \
  ROW(RECTANGLE, "rectangle", "density and transmittance of the segment's end times its length")

// How light reaches a point inside a medium.
#define BRUME_SHADOWS(ROW)                                      \
  ROW(TRACE, "trace", "a ray through the media to every light") \
  ROW(GRID, "grid", "optical depths to every light on a grid, computed once; surfaces block exactly")

#define BRUME_INTERPOLATIONS(ROW)               \
  ROW(NEAREST, "nearest", "constant per voxel") \
  ROW(TRILINEAR, "trilinear", "blends the eight nearest samples")

// How a voxel lies in memory.
#define BRUME_STORAGES(ROW)                                              \
  ROW(F32, "f32", "4 bytes, as given")                                   \
  ROW(F16, "f16", "2 bytes, half precision: off by at most 2^-11 of it") \
  ROW(U8, "u8", "1 byte, 255 parts of its brick's range: off by at most 1/510 of that")

BRUME_SHARED_BEGIN
enum Storage {
#define ROW(id, name, help) STORAGE_##id,
  BRUME_STORAGES(ROW)
#undef ROW
      STORAGE_COUNT
};
enum Method {
#define ROW(id, name, fits, step, draws, help) METHOD_##id,
  BRUME_METHODS(ROW)
#undef ROW
      METHOD_COUNT
};
enum InScattering {
#define ROW(id, name, help) IN_SCATTERING_##id,
  BRUME_IN_SCATTERINGS(ROW)
#undef ROW
      IN_SCATTERING_COUNT
};
enum Shadow {
#define ROW(id, name, help) SHADOW_##id,
  BRUME_SHADOWS(ROW)
#undef ROW
      SHADOW_COUNT
};
enum Interpolation {
#define ROW(id, name, help) INTERPOLATION_##id,
  BRUME_INTERPOLATIONS(ROW)
#undef ROW
      INTERPOLATION_COUNT
};
BRUME_SHARED_END
#endif
