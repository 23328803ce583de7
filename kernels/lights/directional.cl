// A directional light: the same everywhere, from infinitely far away.
#ifndef BRUME_LIGHTS_DIRECTIONAL_CL
#define BRUME_LIGHTS_DIRECTIONAL_CL
#include "lights/light_sample.cl"

static inline LightSample directional_sample(const Light* light, float3 point) {
  (void)point;
  LightSample s;
  s.irradiance = vec_unpack(light->intensity);
  s.travel = vec_unpack(light->direction);
  s.distance = s.reach = INFINITY;
  s.pdf = 1.0f;
  return s;
}

#endif
