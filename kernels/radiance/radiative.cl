// From ∫ρ to light: extinction per channel, transmittance through all media, in-scattering along a view ray.
#ifndef BRUME_RADIANCE_RADIATIVE_CL
#define BRUME_RADIANCE_RADIATIVE_CL
#include "lib/light.cl"
#include "phase/phase.cl"
#include "radiance/light_grid.cl"
#include "shapes/shapes.cl"
#include "transmittance/transmittance.cl"

// Optical depths: one float when every medium is grey, three else.
#if BRUME_COLOR_TAU
typedef float3 tau_t;
#define tau_min(v) vec_min(v)
#define tau_max(v) vec_max(v)
static inline tau_t medium_sigma_t(const Medium* m) { return vec_unpack(m->sigma_a) + vec_unpack(m->sigma_s); }
#else
typedef float tau_t;
#define tau_min(v) (v)
#define tau_max(v) (v)
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
  if (!(tau_max(sigma_t) > 0.0f)) return sigma_t;  // a medium that only glows
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

// One batch of segments along a view ray through medium m.
typedef struct {
  const Medium* medium;
  const MediumRay* ray;
  const Segments* at;
  float3 origin, dir;  // world
  float integral[W];   // ∫ρ over each segment
} Stretch;

// Light l at segment i: E · V · p, and V into the key. 0 when nothing arrives.
static inline float3 stretch_light(const Scene* scene, const Stretch* s, int l, int i, float3* point,
                                   LightSample* light, MediumResult* result) {
  *point = vec_point(s->origin, s->dir, s->ray->t_begin + s->at->place[i]);
  *light = light_sample(scene->lights, l, *point);
  if (!(vec_max(light->irradiance) > 0.0f)) return (float3)(0.0f);
  ++result->shadow_rays;
  if (scene_occluded(scene, *point, -light->travel, light->distance)) {
    result->shadow_key += (uint)(l + 1);
    return (float3)(0.0f);
  }
  return light->irradiance * phase_eval(s->medium->phase, s->medium->g, light->travel, -s->dir);
}

#if BRUME_LIGHT_GRID
static inline void sources_from_grid(const Scene* scene, const Stretch* s, float3* source, MediumResult* result) {
  const int lights = scene->frame->light_count;
  const LightGridPlace place = light_grid_place(s->medium, s->ray, lanes_load(s->at->place));
  for (int l = 0; l < lights; ++l) {
    float transmittance[TAU_CHANNELS][W];
    for (int c = 0; c < TAU_CHANNELS; ++c)
      lanes_store(exp(-light_grid_tau(s->medium, scene->light_tau, &place, lights, l, c)), transmittance[c]);
    result->lookups += (uint)s->at->count;
    for (int i = 0; i < s->at->count; ++i) {
      if (!(s->integral[i] > 0.0f)) continue;
      float3 point;
      LightSample light;
      const float3 arriving = stretch_light(scene, s, l, i, &point, &light, result);
      const float3 t =
          (float3)(transmittance[0][i], transmittance[TAU_CHANNELS / 2][i], transmittance[TAU_CHANNELS - 1][i]);
      source[i] += arriving * t;
    }
  }
}
#endif

static inline void sources_traced(const Scene* scene, const Stretch* s, float3* source, MediumResult* result) {
  for (int l = 0; l < scene->frame->light_count; ++l)
    for (int i = 0; i < s->at->count; ++i) {
      if (!(s->integral[i] > 0.0f)) continue;
      float3 point;
      LightSample light;
      const float3 arriving = stretch_light(scene, s, l, i, &point, &light, result);
      if (vec_max(arriving) > 0.0f)
        source[i] += arriving * media_transmittance(scene, point, -light.travel, light.distance, &result->lookups);
    }
}

// S of each segment: Σ over lights of E · V · T · p.
static inline void stretch_sources(const Scene* scene, const Stretch* s, float3* source, MediumResult* result) {
  for (int i = 0; i < W; ++i) source[i] = (float3)(0.0f);
  if (!(vec_max(vec_unpack(s->medium->sigma_s)) > 0.0f)) return;
#if BRUME_LIGHT_GRID
  if (s->medium->light_nx > 0) {
    sources_from_grid(scene, s, source, result);
    return;
  }
#endif
  sources_traced(scene, s, source, result);
}

// ∫ρT over a segment: what each unit of σs S + emission in it sends to the origin. `before`: τ up to the segment, `own`: τ of it.
// An extinction below 1e-20 is none: the quotient would lose it.
#define SEGMENT_GAIN(frame, sigma_t, integral, before, own) \
  ((frame)->in_scattering == IN_SCATTERING_RECTANGLE        \
       ? exp(-((before) + (own))) * (integral)              \
       : ((sigma_t) > 1e-20f ? exp(-(before)) * -expm1(-(own)) / (sigma_t) : exp(-(before)) * (integral)))

static inline void stretch_gains(const Scene* scene, tau_t sigma_t, const float* integral, const tau_t* before,
                                 tau_t* gain) {
#if BRUME_COLOR_TAU
  for (int i = 0; i < W; ++i) {
    const tau_t own = sigma_t * integral[i];
    gain[i].x = SEGMENT_GAIN(scene->frame, sigma_t.x, integral[i], before[i].x, own.x);
    gain[i].y = SEGMENT_GAIN(scene->frame, sigma_t.y, integral[i], before[i].y, own.y);
    gain[i].z = SEGMENT_GAIN(scene->frame, sigma_t.z, integral[i], before[i].z, own.z);
  }
#else
  const floatW b = lanes_load(before), length = lanes_load(integral);
  lanes_store(SEGMENT_GAIN(scene->frame, sigma_t, length, b, sigma_t * length), gain);
#endif
}

// Medium m along a view ray up to t_max: adds what it scatters and emits towards the origin to *radiance and returns its
// optical depth.
static inline tau_t medium_scatter(const Scene* scene, int m, float3 origin, float3 dir, float t_max, float3* radiance,
                                   MediumResult* result) {
  const Medium medium = scene->media[m];
  const tau_t sigma_t = medium_sigma_t(&medium);
  const float3 sigma_s = vec_unpack(medium.sigma_s), emission = vec_unpack(medium.emission);
  const MediumRay ray = medium_ray(&medium, origin, dir, t_max);
  tau_t tau = (tau_t)(0.0f);
  if (!(ray.length > 0.0f)) return tau;
  Walk walk = walk_begin(&medium, &ray);
  Segments at;
  Stretch stretch;
  stretch.medium = &medium;
  stretch.ray = &ray;
  stretch.at = &at;
  stretch.origin = origin;
  stretch.dir = dir;
  for (walk_next(scene, &medium, &ray, &walk, &at); at.count > 0 && tau_min(tau) < TAU_STOP;
       walk_next(scene, &medium, &ray, &walk, &at)) {
    lanes_store(walk_integral(scene, &medium, &ray, &at), stretch.integral);
    result->lookups += walk_lookups(&medium, &at);
    float3 source[W];
    stretch_sources(scene, &stretch, source, result);
    tau_t before[W], gain[W];
    for (int i = 0; i < W; ++i) {
      before[i] = tau;
#if BRUME_MEDIA == 2
      if (stretch.integral[i] > 0.0f)
        before[i] += media_tau(scene, m, origin, dir, ray.t_begin + at.place[i], &result->lookups);
#endif
      tau += sigma_t * stretch.integral[i];
    }
    stretch_gains(scene, sigma_t, stretch.integral, before, gain);
    for (int i = 0; i < at.count; ++i) *radiance += (sigma_s * source[i] + emission) * gain[i];
  }
  return tau;
}

// All media along a view ray.
static inline MediumResult media_scatter(const Scene* scene, float3 origin, float3 dir, float t_max) {
  MediumResult result;
  result.lookups = 0;
  result.shadow_key = 0;
  result.shadow_rays = 0;
  result.secondary_rays = 0;
  result.pad[0] = result.pad[1] = 0;
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
