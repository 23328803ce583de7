// Lights. E is the irradiance at normal incidence: intensity/d² (inverse_square), intensity (none) or
// the irradiance itself (directional).
// A light of the scene file has no extent. A surface whose material emits is a light too; each of the points at which
// it is asked is a Light of its own (RenderPlan::lights).
#ifndef BRUME_SHARED_LIGHT_H
#define BRUME_SHARED_LIGHT_H
#include "shared/platform.h"

// ROW(ID, name; kernels: NAME_sample, help)
#define BRUME_LIGHTS(ROW)                                                                   \
  ROW(POINT, point, "position, intensity in W/sr, falloff")                                 \
  ROW(DIRECTIONAL, directional, "direction in which the light travels, irradiance in W/m²") \
  ROW(SPOT, spot, "a point light within a cone of half-angle `angle` degrees about direction")

// How many lights a point asks: all of up to LIGHTS_ENUMERATED, of more LIGHT_PICKS chosen at random by their power,
// unless render.light_picks says otherwise; never more than LIGHT_PICKS_MAX.
#define LIGHTS_ENUMERATED 256
#define LIGHT_PICKS 32
#define LIGHT_PICKS_MAX 65536

// Of so many at most depths are interpolated where several media stand on one spot (kernels/media/ladder.cl).
#define LADDER_LIGHTS 4

#define BRUME_FALLOFFS(ROW)                                   \
  ROW(INVERSE_SQUARE, "inverse_square", "E = intensity / d²") \
  ROW(NONE, "none", "E = intensity at any distance")

// At which points a surface that emits is asked.
#define BRUME_LIGHT_POINTS(ROW)                                                           \
  ROW(STRATIFIED, "stratified", "light_samples of them at random, evenly spread over it") \
  ROW(CENTROID, "centroid", "one in its middle")

BRUME_SHARED_BEGIN
enum LightPoints {
#define ROW(id, name, help) LIGHT_POINTS_##id,
  BRUME_LIGHT_POINTS(ROW)
#undef ROW
      LIGHT_POINTS_COUNT
};
enum LightType {
#define ROW(id, name, help) LIGHT_##id,
  BRUME_LIGHTS(ROW)
#undef ROW
      LIGHT_COUNT,
  LIGHT_SURFACE = LIGHT_COUNT,  // one of the points of a surface that emits; no type of a scene file
  LIGHT_TYPES
};
enum Falloff {
#define ROW(id, name, help) FALLOFF_##id,
  BRUME_FALLOFFS(ROW)
#undef ROW
      FALLOFF_COUNT
};

// A light far from the scene has a length of its own, 2^exponent flat units, in which its position and intensity are
// given: neither its distance nor the square of it leaves float.
typedef struct {
  Packed3 position;
  int type;
  Packed3 direction;  // unit; the direction the light travels
  int falloff;
  Packed3 intensity;  // W/sr; W/m² for directional; of a surface its radiance
  // Of 1 - cos(angle to direction), in which float tells the narrowest cones apart:
  float outer;  // spot: no light from here on; a surface: its area
  float inner;  // spot: full light up to here; smoothstep x²(3-2x) in the cosine between the two
  int exponent;
  // A surface: which, and point `point` of `points` on it; 0 points: its middle. `position` is its middle too.
  int primitive, instance;  // as in shared/ray.h
  int point, points;
} Light;
BRUME_LAYOUT(Light, 72);
BRUME_SHARED_END
#endif
