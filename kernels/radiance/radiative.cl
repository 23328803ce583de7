// From ∫ρ to light: extinction per channel, transmittance through all media, in-scattering along a view ray.
#ifndef BRUME_RADIANCE_RADIATIVE_CL
#define BRUME_RADIANCE_RADIATIVE_CL
#include "lib/light.cl"
#include "phase/phase.cl"
#include "shapes/shapes.cl"
#include "transmittance/transmittance.cl"

// Optical depths: one float when every medium is grey, three else.
#if BRUME_COLOR_TAU
typedef float3 tau_t;
#define tau_min(v) vec_min(v)
static inline tau_t medium_sigma_t(const Medium* m) { return vec_unpack(m->sigma_a) + vec_unpack(m->sigma_s); }
#else
typedef float tau_t;
#define tau_min(v) (v)
static inline tau_t medium_sigma_t(const Medium* m) { return m->sigma_a.x + m->sigma_s.x; }
#endif

#if BRUME_MEDIA == 1
#define MEDIA_END(scene) 1
#else
#define MEDIA_END(scene) ((scene)->frame->medium_count)
#endif

// Optical depth of medium m from the origin to t_max.
static inline tau_t medium_tau(const Scene* scene, int m, float3 origin, float3 dir, float t_max, uint* lookups) {
  const Medium medium = scene->media[m];
  const tau_t sigma_t = medium_sigma_t(&medium);
  const MediumRay ray = medium_ray(&medium, origin, dir, t_max);
  return sigma_t * walk_total(scene, &medium, &ray, TAU_STOP / fmax(tau_min(sigma_t), 1e-30f), lookups);
}

// Transmittance of all media but `except` from the origin to t_max.
static inline tau_t media_tau(const Scene* scene, int except, float3 origin, float3 dir, float t_max, uint* lookups) {
  tau_t tau = (tau_t)(0.0f);
#if BRUME_MEDIA
  for (int m = 0; m < MEDIA_END(scene); ++m)
    if (m != except) tau += medium_tau(scene, m, origin, dir, t_max, lookups);
#endif
  return tau;
}

static inline float3 media_transmittance(const Scene* scene, float3 origin, float3 dir, float t_max, uint* lookups) {
  return (float3)(1.0f) * exp(-media_tau(scene, -1, origin, dir, t_max, lookups));
}

// Σ over lights of E · V · T · p at a point inside a medium, for light that goes on along `after`.
static inline float3 light_scattered(const Scene* scene, const Medium* medium, float3 point, float3 after,
                                     MediumResult* result) {
  float3 sum = (float3)(0.0f);
  for (int l = 0; l < scene->frame->light_count; ++l) {
    const LightSample light = light_sample(scene->lights, l, point);
    if (!(vec_max(light.irradiance) > 0.0f)) continue;
    const float3 to_light = -light.travel;
    ++result->shadow_rays;
    if (scene_occluded(scene, point, to_light, light.distance)) {
      result->shadow_key += (uint)(l + 1);
      continue;
    }
    const float3 arriving =
        light.irradiance * media_transmittance(scene, point, to_light, light.distance, &result->lookups);
    sum += arriving * phase_eval(medium->phase, medium->g, light.travel, after);
  }
  return sum;
}

static inline float3 medium_albedo(const Medium* m) {
  const float3 s = vec_unpack(m->sigma_s), t = vec_unpack(m->sigma_a) + s;
  return (float3)(t.x > 0.0f ? s.x / t.x : 0.0f, t.y > 0.0f ? s.y / t.y : 0.0f, t.z > 0.0f ? s.z / t.z : 0.0f);
}

// Medium m along a view ray up to t_max: adds its in-scattered radiance to *radiance and returns its optical depth.
static inline tau_t medium_scatter(const Scene* scene, int m, float3 origin, float3 dir, float t_max, float3* radiance,
                                   MediumResult* result) {
  const Medium medium = scene->media[m];
  const tau_t sigma_t = medium_sigma_t(&medium);
  const float3 albedo = medium_albedo(&medium);
  const MediumRay ray = medium_ray(&medium, origin, dir, t_max);
  tau_t tau = (tau_t)(0.0f);
  if (!(ray.length > 0.0f)) return tau;
  Walk walk = walk_begin(&medium, &ray);
  Segments at;
  for (walk_next(scene, &medium, &ray, &walk, &at); at.count > 0 && tau_min(tau) < TAU_STOP;
       walk_next(scene, &medium, &ray, &walk, &at)) {
    float integral[W];
    lanes_store(walk_integral(scene, &medium, &ray, &at), integral);
    result->lookups += walk_lookups(&medium, &at);
    for (int i = 0; i < at.count; ++i) {
      const tau_t segment = sigma_t * integral[i];
      if (!(integral[i] > 0.0f)) continue;
      const float t = ray.t_begin + at.middle[i];
      tau_t before = tau;
#if BRUME_MEDIA == 2
      before += media_tau(scene, m, origin, dir, t, &result->lookups);
#endif
      const float3 light = light_scattered(scene, &medium, vec_point(origin, dir, t), -dir, result);
      *radiance += light * albedo * (exp(-before) * -expm1(-segment));
      tau += segment;
    }
  }
  return tau;
}

// All media along a view ray.
static inline MediumResult media_scatter(const Scene* scene, float3 origin, float3 dir, float t_max) {
  MediumResult result;
  result.lookups = 0;
  result.shadow_key = 0;
  result.shadow_rays = 0;
  float3 radiance = (float3)(0.0f);
  tau_t tau = (tau_t)(0.0f);
#if BRUME_MEDIA
  for (int m = 0; m < MEDIA_END(scene); ++m) tau += medium_scatter(scene, m, origin, dir, t_max, &radiance, &result);
#endif
  result.transmittance = vec_pack((float3)(1.0f) * exp(-tau));
  result.radiance = vec_pack(radiance);
  return result;
}

#endif
