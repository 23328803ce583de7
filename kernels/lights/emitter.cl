// A surface that emits, asked at one point of it (PICTURE, Lights with an area).
#ifndef BRUME_LIGHTS_EMITTER_CL
#define BRUME_LIGHTS_EMITTER_CL
#include "lib/rng.cl"
#include "lib/sobol.cl"
#include "lights/light_sample.cl"
#include "materials/material.cl"

#define EMITTER_CLEAR 0x1p-12f  // of the way to it: what is nearer to the surface than that blocks nothing

// Two numbers in [0, 1): those of the ray for this point, spread evenly over all points of all samples. `middle`: of a
// light that is asked there.
static inline float2 emitter_choice(const Light* light, Random random, float2 middle) {
  if (light->points == 0) return middle;
  const Random own = random_stream(random, STREAM_LIGHT_PLACE);
  const uint index = own.sample * (uint)light->points + (uint)light->point;
  return sobol_scrambled(index, own.pixel, primitive_name(light->primitive, light->instance), own.seed);
}

#if BRUME_TRIANGLES
static inline ShapePlace triangle_emit(const Scene* scene, const Light* light, float3 from, Random random,
                                       float3* radiance) {
#if BRUME_INSTANCES
  float3 geometric;
  const Triangle t = triangle_of(scene, light->primitive, light->instance, &geometric);
#else
  const Triangle t = scene->triangles[light->primitive - FIRST_TRIANGLE];  // its normal is not asked for
#endif
  const float2 xi = emitter_choice(light, random, (float2)(4.0f / 9.0f, 0.5f));
  const float root = sqrt(xi.x), u = root * (1.0f - xi.y), v = root * xi.y, w = 1.0f - root;  // evenly [Turk90]
  const float3 p0 = vec_unpack(t.p[0]), p1 = vec_unpack(t.p[1]), p2 = vec_unpack(t.p[2]);
  const float3 normal = cross(p1 - p0, p2 - p0);
  uint second;
  *radiance = texture_times(scene, light->intensity, scene->materials[t.material].emission_texture,
                            triangle_uv(&t, w, u, v), &second);
  return shape_place_of(w * (p0 - from) + u * (p1 - from) + v * (p2 - from), normal, 0.5f * length(normal));
}
#endif

static inline LightSample emitter_sample(const Scene* scene, const Light* light, float3 point, Random random) {
  float3 radiance = vec_unpack(light->intensity);
  ShapePlace place;
#if BRUME_TRIANGLES
  if (light->primitive >= FIRST_TRIANGLE) {
    place = triangle_emit(scene, light, point, random, &radiance);
  } else
#endif
  {
    const Shape shape = scene->shapes[light->primitive];
    const float middle = shape.type == SHAPE_SPHERE ? 0.0f : 0.5f;
    place = shape_emit(&shape, point, emitter_choice(light, random, (float2)(middle)));
  }
  LightSample s;
  s.distance = length(place.way);
  s.reach = s.distance * (1.0f - EMITTER_CLEAR);
  s.travel = s.distance > 0.0f ? -place.way / s.distance : (float3)(0.0f, 0.0f, 1.0f);
  s.pdf = place.solid > 0.0f ? 1.0f / place.solid : 0.0f;
  s.irradiance = radiance * place.solid / (float)max(light->points, 1);
  return s;
}

#endif
