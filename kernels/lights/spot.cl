// A spot: a point light within a cone.
#ifndef BRUME_LIGHTS_SPOT_CL
#define BRUME_LIGHTS_SPOT_CL
#include "lights/point.cl"

// 1 - cos of the angle between unit vectors is half the square of their difference.
static inline float spot_cone(const Light* light, float3 travel) {
  const float3 off = travel - vec_unpack(light->direction);
  const float beside = 0.5f * dot(off, off);
  if (beside >= light->outer) return 0.0f;
  if (beside <= light->inner) return 1.0f;
  const float x = (light->outer - beside) / (light->outer - light->inner);
  return x * x * (3.0f - 2.0f * x);
}

static inline LightSample spot_sample(const Light* light, float3 point) {
  LightSample s = point_sample(light, point);
  if (s.distance > 0.0f) s.irradiance *= spot_cone(light, s.travel);
  return s;
}

#endif
