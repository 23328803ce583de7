// Lights without extent: direction of travel and irradiance at normal incidence, as shared/light.h defines them.
#ifndef BRUME_LIB_LIGHT_CL
#define BRUME_LIB_LIGHT_CL
#include "lib/scene.cl"

typedef struct {
  float3 travel;      // unit, from the light to the point
  float3 irradiance;  // at normal incidence, before anything blocks it
  float distance;     // to the light; INFINITY for directional
} LightSample;

// 1 - cos of the angle between unit vectors is half the square of their difference.
static inline float spot_cone(const Light* light, float3 travel) {
  const float3 off = travel - vec_unpack(light->direction);
  const float beside = 0.5f * dot(off, off);
  if (beside >= light->outer) return 0.0f;
  if (beside <= light->inner) return 1.0f;
  const float x = (light->outer - beside) / (light->outer - light->inner);
  return x * x * (3.0f - 2.0f * x);
}

static inline LightSample light_sample(__global const Light* lights, int index, float3 point) {
  const Light light = lights[index];
  LightSample s;
  s.irradiance = vec_unpack(light.intensity);
  s.travel = vec_unpack(light.direction);
  s.distance = INFINITY;
  if ((USES_LIGHT(POINT) || USES_LIGHT(SPOT)) && light.type != LIGHT_DIRECTIONAL) {
    const int far = light.exponent != 0;  // few are: a branch costs less than two ldexp
    const float3 to_point = (far ? point * ldexp(1.0f, -light.exponent) : point) - vec_unpack(light.position);
    const float distance = length(to_point);
    s.distance = far ? ldexp(distance, light.exponent) : distance;
    if (!(distance > 0.0f)) {  // at the light itself there is no direction, and nothing arrives
      s.irradiance = (float3)(0.0f);
      return s;
    }
    s.travel = to_point / distance;
    if (light.falloff == FALLOFF_INVERSE_SQUARE) s.irradiance = s.irradiance / distance / distance;
    if (USES_LIGHT(SPOT) && light.type == LIGHT_SPOT) s.irradiance *= spot_cone(&light, s.travel);
  }
  return s;
}

#endif
