// Transmittance methods: how ∫ρ dt along a ray is found and into which segments in-scattering is cut.
// Every method is a placement (where segments begin and end) and a rule (∫ρ over one segment).
#ifndef BRUME_SHARED_METHOD_H
#define BRUME_SHARED_METHOD_H
#include "shared/platform.h"

// What a density is: bits of `fits` and `exact`.
#define FITS_NEAREST 1
#define FITS_TRILINEAR 2
#define FITS_CONSTANT 4
#define FITS_PRESENCE 8  // of a liquid: below a threshold it counts as 0

// What a method draws random numbers for.
#define DRAWS_NOTHING 0
#define DRAWS_PLACES 1      // where in each step to sample
#define DRAWS_COLLISIONS 2  // where to collide: right in the mean for any density

// Ratio and residual ratio tracking ask for light at a tentative collision with TRACK_LIGHTS times the probability that
// it is real (at most 1): a brick with one hot voxel has a million collisions that hardly scatter.
#define TRACK_LIGHTS 4.0f

// A brick that would need this many pieces per cell of way, or more, is walked by its cells.
#define PIECE_RATE_CELLS 2.0f
// Rows of RenderPlan::piece_rates: rate of view rays, rate of rays to lights, mean square error of ∫ρ per cell of way.
#define PIECE_ROW 3
#define PIECE_LIGHT 1
#define PIECE_ROUGH 2

// Where segments begin and end. PLACEMENT(ID, help)
#define BRUME_PLACEMENTS(PLACEMENT)                                                   \
  PLACEMENT(CELLS, "at the faces of cells, empty bricks left out")                    \
  PLACEMENT(STEPS, "equal steps of at most render.step")                              \
  PLACEMENT(PIECES, "at equal pieces of bricks, of rough ones at the faces of cells") \
  PLACEMENT(COLLISIONS, "at tentative collisions")

// ∫ρ over one. RULE(ID, kernel function NAME_integral, density lookups)
#define BRUME_RULES(RULE)         \
  RULE(NEAREST, dda_nearest, 1)   \
  RULE(GAUSS2, dda_gauss2, 2)     \
  RULE(MIDPOINT, dda_midpoint, 1) \
  RULE(SAMPLE, march, 1)          \
  RULE(PRODUCT, homogeneous, 0)   \
  RULE(PIECE, piece, 2)           \
  RULE(LINEAR, linear, 1)

// ROW(ID, name, densities that it fits, placement, rule, share of a segment before its sample, over how much more of it
// the sample is drawn, draws, densities for which it is exact, or as close as any, help). `auto` takes the first of these.
#define BRUME_METHODS(ROW)                                                                                          \
  ROW(DDA_NEAREST, "dda_nearest", FITS_NEAREST, CELLS, NEAREST, 0.5f, 0.0f, DRAWS_NOTHING, FITS_NEAREST,            \
      "voxel by voxel; exact for nearest")                                                                          \
  ROW(DDA_GAUSS2, "dda_gauss2", FITS_TRILINEAR, CELLS, GAUSS2, 0.5f, 0.0f, DRAWS_NOTHING, FITS_TRILINEAR,           \
      "cell by cell, 2-point Gauss-Legendre; exact for trilinear")                                                  \
  ROW(DDA_MIDPOINT, "dda_midpoint", FITS_TRILINEAR, CELLS, MIDPOINT, 0.5f, 0.0f, DRAWS_NOTHING, 0,                  \
      "cell by cell, one sample in the middle")                                                                     \
  ROW(MARCH_REGULAR, "march_regular", FITS_NEAREST | FITS_TRILINEAR, STEPS, SAMPLE, 0.0f, 0.0f, DRAWS_NOTHING, 0,   \
      "equal steps, one sample where each begins")                                                                  \
  ROW(MARCH_REGULAR_JITTER, "march_regular_jitter", FITS_NEAREST | FITS_TRILINEAR, STEPS, SAMPLE, 0.0f, 1.0f,       \
      DRAWS_PLACES, 0, "equal steps, one sample anywhere in each")                                                  \
  ROW(MARCH_MIDPOINT, "march_midpoint", FITS_NEAREST | FITS_TRILINEAR, STEPS, SAMPLE, 0.5f, 0.0f, DRAWS_NOTHING, 0, \
      "equal steps, one sample in the middle of each")                                                              \
  ROW(MARCH_MIDPOINT_JITTER, "march_midpoint_jitter", FITS_NEAREST | FITS_TRILINEAR, STEPS, SAMPLE, 0.25f, 0.5f,    \
      DRAWS_PLACES, 0, "equal steps, one sample anywhere in the middle half of each")                               \
  ROW(DELTA_TRACKING, "delta_tracking", FITS_NEAREST | FITS_TRILINEAR, COLLISIONS, SAMPLE, 0.0f, 0.0f,              \
      DRAWS_COLLISIONS, 0, "to the first collision; unbiased, noisy: transmittance is 0 or 1")                      \
  ROW(RATIO_TRACKING, "ratio_tracking", FITS_NEAREST | FITS_TRILINEAR, COLLISIONS, SAMPLE, 0.0f, 0.0f,              \
      DRAWS_COLLISIONS, 0, "through all collisions, weakened by each; unbiased")                                    \
  ROW(RESIDUAL_RATIO, "residual_ratio", FITS_NEAREST | FITS_TRILINEAR, COLLISIONS, SAMPLE, 0.0f, 0.0f,              \
      DRAWS_COLLISIONS, 0, "ratio tracking of what exceeds each brick's smallest density; unbiased")                \
  ROW(HOMOGENEOUS, "homogeneous", FITS_CONSTANT, STEPS, PRODUCT, 0.5f, 0.0f, DRAWS_NOTHING, FITS_CONSTANT,          \
      "closed form for a constant density (also cut to a sphere); equal steps for the light")                       \
  ROW(ADAPTIVE, "adaptive", FITS_TRILINEAR | FITS_CONSTANT, PIECES, PIECE, 0.5f, 0.0f, DRAWS_NOTHING, 0,            \
      "as fine as render.tolerance asks: pieces of bricks, light where it bends")                                   \
  ROW(MARCH_LINEAR, "march_linear", FITS_PRESENCE, STEPS, LINEAR, 0.5f, 0.0f, DRAWS_NOTHING, FITS_PRESENCE,         \
      "equal steps, between which the presence of a liquid is taken to be linear")

// How the light scattered along a segment is summed.
#define BRUME_IN_SCATTERINGS(ROW)                                                                \
  ROW(SEGMENT, "segment", "exact for constant light over each segment: stable at any step")      \
  ROW(RECTANGLE, "rectangle", "density and transmittance of the segment's end times its length") \
  ROW(GAUSS2, "gauss2", "light at two points of each segment: of fourth order where light is smooth")

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
#define ROW(id, name, fits, placement, rule, share, jitter, draws, exact, help) METHOD_##id,
  BRUME_METHODS(ROW)
#undef ROW
      METHOD_COUNT
};
enum Placement {
#define PLACEMENT(id, help) PLACEMENT_##id,
  BRUME_PLACEMENTS(PLACEMENT)
#undef PLACEMENT
      PLACEMENT_COUNT
};
enum Rule {
#define RULE(id, function, lookups) RULE_##id,
  BRUME_RULES(RULE)
#undef RULE
      RULE_COUNT
};

// A row of the table above.
typedef struct {
  int fits, placement, rule;
  float share, jitter;
  int draws, exact;
} MethodRow;

static inline MethodRow method_row(int method) {
  MethodRow row = {0, 0, 0, 0.0f, 0.0f, 0, 0};
#define ROW(id, name, fits, placement, rule, share, jitter, draws, exact, help)                    \
  if (method == METHOD_##id) {                                                                     \
    const MethodRow its = {fits, PLACEMENT_##placement, RULE_##rule, share, jitter, draws, exact}; \
    row = its;                                                                                     \
  }
  BRUME_METHODS(ROW)
#undef ROW
  return row;
}

static inline int method_fits(int method) { return method_row(method).fits; }
static inline int method_placement(int method) { return method_row(method).placement; }
static inline int method_rule(int method) { return method_row(method).rule; }
static inline float method_share(int method) { return method_row(method).share; }
static inline float method_jitter(int method) { return method_row(method).jitter; }
static inline int method_draws(int method) { return method_row(method).draws; }
static inline int method_exact_for(int method) { return method_row(method).exact; }

// Density lookups of one segment by a rule.
static inline int rule_lookups(int rule) {
  switch (rule) {
#define RULE(id, function, lookups) \
  case RULE_##id:                   \
    return lookups;
    BRUME_RULES(RULE)
#undef RULE
    default:
      return 0;
  }
}

static inline int method_has_step(int method) { return method_placement(method) == PLACEMENT_STEPS; }
static inline int method_has_tolerance(int method) { return method_placement(method) == PLACEMENT_PIECES; }
static inline int method_tracks(int method) { return method_placement(method) == PLACEMENT_COLLISIONS; }

// `auto`: the first method that is exact for one of these densities (FITS_x bits).
static inline int method_exact_of(int fits) {
  for (int method = 0; method < METHOD_COUNT; ++method)
    if (method_exact_for(method) & fits) return method;
  return METHOD_COUNT;
}
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
