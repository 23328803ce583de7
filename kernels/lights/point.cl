// A point light.
#ifndef BRUME_LIGHTS_POINT_CL
#define BRUME_LIGHTS_POINT_CL
#include "lights/light_sample.cl"

static inline LightSample point_sample(const Light* light, float3 point) {
  const int far = light->exponent != 0;  // few are: a branch costs less than two ldexp
  const float3 to_point = (far ? point * ldexp(1.0f, -light->exponent) : point) - vec_unpack(light->position);
  const float distance = length(to_point);
  LightSample s;
  s.distance = s.reach = far ? ldexp(distance, light->exponent) : distance;
  s.irradiance = vec_unpack(light->intensity);
  s.travel = vec_unpack(light->direction);
  s.pdf = 1.0f;
  if (!(distance > 0.0f)) {  // at the light itself there is no direction, and nothing arrives
    s.irradiance = (float3)(0.0f);
    return s;
  }
  s.travel = to_point / distance;
  if (light->falloff == FALLOFF_INVERSE_SQUARE) s.irradiance = s.irradiance / distance / distance;
  return s;
}

#endif
