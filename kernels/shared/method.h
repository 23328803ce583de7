// Transmittance methods: how ∫ρ dt along a ray is found and into which segments in-scattering is cut.
// Every method is a placement (where segments begin and end) and a rule (∫ρ over one segment).
#ifndef BRUME_SHARED_METHOD_H
#define BRUME_SHARED_METHOD_H
#include "shared/platform.h"

#define FITS_NEAREST 1
#define FITS_TRILINEAR 2
#define FITS_CONSTANT 4

// ROW(ID, name, fits, has a step, help)
#define BRUME_METHODS(ROW)                                                                                           \
  ROW(DDA_NEAREST, "dda_nearest", FITS_NEAREST, 0, "voxel by voxel; exact for nearest")                              \
  ROW(DDA_GAUSS2, "dda_gauss2", FITS_TRILINEAR, 0, "cell by cell, 2-point Gauss-Legendre; exact for trilinear")      \
  ROW(DDA_MIDPOINT, "dda_midpoint", FITS_TRILINEAR, 0, "cell by cell, one sample in the middle")                     \
  ROW(MARCH_REGULAR, "march_regular", FITS_NEAREST | FITS_TRILINEAR, 1, "equal steps, one sample where each begins") \
  ROW(MARCH_MIDPOINT, "march_midpoint", FITS_NEAREST | FITS_TRILINEAR, 1,                                            \
      "equal steps, one sample in the middle of each")                                                               \
  ROW(HOMOGENEOUS, "homogeneous", FITS_CONSTANT, 1,                                                                  \
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

BRUME_SHARED_BEGIN
enum Method {
#define ROW(id, name, fits, step, help) METHOD_##id,
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
