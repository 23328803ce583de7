// From ∫ρ to light: extinction per channel, transmittance through all media, in-scattering along a view ray.
#ifndef BRUME_RADIANCE_RADIATIVE_CL
#define BRUME_RADIANCE_RADIATIVE_CL
#include "lib/light.cl"
#include "phase/phase.cl"
#include "radiance/light_grid.cl"
#include "radiance/tau.cl"
#include "shapes/shapes.cl"

// RGB of every lane.
typedef struct {
  floatW x, y, z;
} Colors;

// One batch of segments along a view ray through medium m.
typedef struct {
  const Medium* medium;
  const MediumRay* ray;
  const Segments* at;
  float3 origin, dir;         // world
  Random walk;                // of the walk through this medium
  float integral[W];          // ∫ρ over each segment; 0 where no light is asked for
  floatW gain[TAU_CHANNELS];  // ∫ρT over each segment: what each unit of σs S + emission in it sends to the origin
} Stretch;

// Light l at segment i: E · V · p, and V into the key. 0 when nothing arrives.
static inline float3 segment_arriving(const Scene* scene, const Stretch* s, int l, int i, float3* point,
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
// Light l at all segments: E · V · p.
static inline Colors stretch_arriving(const Scene* scene, const Stretch* s, int l, MediumResult* result) {
  Colors out;
  float3 point;
  LightSample light;
#if !HAS_SURFACES
  if (USES_LIGHT(DIRECTIONAL) && scene->lights[l].type == LIGHT_DIRECTIONAL) {  // the same everywhere
    const float3 arriving = segment_arriving(scene, s, l, 0, &point, &light, result);
    result->shadow_rays += (uint)(s->at->count - 1);
    out.x = (floatW)(arriving.x);
    out.y = (floatW)(arriving.y);
    out.z = (floatW)(arriving.z);
    return out;
  }
#endif
  float x[W], y[W], z[W];
  for (int i = 0; i < W; ++i) {
    float3 arriving = (float3)(0.0f);
    if (s->integral[i] > 0.0f) arriving = segment_arriving(scene, s, l, i, &point, &light, result);
    x[i] = arriving.x;
    y[i] = arriving.y;
    z[i] = arriving.z;
  }
  out.x = lanes_load(x);
  out.y = lanes_load(y);
  out.z = lanes_load(z);
  return out;
}

static inline Colors sources_from_grid(const Scene* scene, const Stretch* s, MediumResult* result) {
  Colors sum = {(floatW)(0.0f), (floatW)(0.0f), (floatW)(0.0f)};
  for (int l = 0; l < scene->frame->light_count; ++l) {
    const LightGrid grid = scene->light_grids[s->medium->light_grids - 1 + l];
    const LightGridPlace place = light_grid_place(&grid, s->ray, lanes_load(s->at->place));
    floatW t[TAU_CHANNELS];
    for (int c = 0; c < TAU_CHANNELS; ++c) t[c] = exp(-light_grid_tau(&grid, scene->light_tau, &place, c));
    result->lookups += (uint)s->at->count;
    const Colors arriving = stretch_arriving(scene, s, l, result);
    sum.x += arriving.x * t[0];
    sum.y += arriving.y * t[TAU_CHANNELS / 2];
    sum.z += arriving.z * t[TAU_CHANNELS - 1];
  }
  return sum;
}
#endif

static inline Colors sources_traced(const Scene* scene, const Stretch* s, MediumResult* result) {
  float x[W], y[W], z[W];
  for (int i = 0; i < W; ++i) {
    float3 sum = (float3)(0.0f);
    for (int l = 0; l < scene->frame->light_count; ++l) {
      if (!(s->integral[i] > 0.0f)) continue;
      float3 point;
      LightSample light;
      const float3 arriving = segment_arriving(scene, s, l, i, &point, &light, result);
      if (!(vec_max(arriving) > 0.0f)) continue;
      const Random random = random_stream(random_stream(s->walk, walk_id(s->medium, s->at, i)), STREAM_LIGHT + (uint)l);
      sum += arriving * media_transmittance(scene, point, -light.travel, light.distance, random, &result->lookups);
    }
    x[i] = sum.x;
    y[i] = sum.y;
    z[i] = sum.z;
  }
  const Colors out = {lanes_load(x), lanes_load(y), lanes_load(z)};
  return out;
}

// S of each segment: Σ over lights of E · V · T · p.
static inline Colors stretch_sources(const Scene* scene, const Stretch* s, MediumResult* result) {
#if BRUME_LIGHT_GRID
  if (s->medium->light_grids > 0) return sources_from_grid(scene, s, result);
#endif
  return sources_traced(scene, s, result);
}

// What medium m sends to the origin from these segments.
static inline float3 stretch_radiance(const Scene* scene, const Stretch* s, MediumResult* result) {
  const float3 sigma_s = vec_unpack(s->medium->sigma_s), emission = vec_unpack(s->medium->emission);
  Colors source = {(floatW)(0.0f), (floatW)(0.0f), (floatW)(0.0f)};
  if (vec_max(sigma_s) > 0.0f) source = stretch_sources(scene, s, result);
  return (float3)(lanes_sum((source.x * sigma_s.x + emission.x) * s->gain[0]),
                  lanes_sum((source.y * sigma_s.y + emission.y) * s->gain[TAU_CHANNELS / 2]),
                  lanes_sum((source.z * sigma_s.z + emission.z) * s->gain[TAU_CHANNELS - 1]));
}

// τ of the media beside m up to segment i.
static inline tau_t stretch_others(const Scene* scene, const Stretch* s, int m, int i, MediumResult* result) {
#if BRUME_MEDIA == 2
  const Random random = random_stream(random_stream(s->walk, walk_id(s->medium, s->at, i)), STREAM_OTHERS);
  return media_tau(scene, m, s->origin, s->dir, s->ray->t_begin + s->at->place[i], random, &result->lookups);
#else
  return (tau_t)(0.0f);
#endif
}

// No light is asked for from segment i on.
static inline void stretch_cut(Stretch* s, int i) {
  for (; i < W; ++i) s->integral[i] = 0.0f;
}

// Segment rule: exact for constant light over the segment. An extinction below 1e-20 is none: the quotient would lose it.
static inline floatW segment_gain(const Scene* scene, float sigma_t, floatW integral, floatW before) {
  const floatW own = sigma_t * integral;
  if (scene->frame->in_scattering == IN_SCATTERING_RECTANGLE) return exp(-(before + own)) * integral;
  return sigma_t > 1e-20f ? exp(-before) * lanes_one_minus_exp(own) * (1.0f / sigma_t) : exp(-before) * integral;
}

// τ of medium m up to each segment; moves *tau past them all.
static inline void stretch_before(const Scene* scene, Stretch* s, tau_t sigma_t, tau_t* tau, floatW* before) {
#if BRUME_ROULETTE
  float each[TAU_CHANNELS][W];
  for (int i = 0; i < W; ++i) {
    for (int c = 0; c < TAU_CHANNELS; ++c) each[c][i] = tau_channel(*tau, c);
    *tau += sigma_t * s->integral[i];
    if (s->integral[i] > 0.0f && !roulette_survives(scene, &s->walk, walk_id(s->medium, s->at, i), tau))
      stretch_cut(s, i + 1);
  }
  for (int c = 0; c < TAU_CHANNELS; ++c) before[c] = lanes_load(each[c]);
#else
  const floatW integral = lanes_load(s->integral), walked = lanes_before(integral);
  for (int c = 0; c < TAU_CHANNELS; ++c)
    before[c] = mad_exact((floatW)(tau_channel(sigma_t, c)), walked, (floatW)(tau_channel(*tau, c)));
  *tau += sigma_t * lanes_sum(integral);
#endif
}

// Gains of the segments; moves *tau, that of medium m, past them.
static inline void stretch_gains(const Scene* scene, Stretch* s, int m, tau_t sigma_t, tau_t* tau,
                                 MediumResult* result) {
  floatW before[TAU_CHANNELS];
  stretch_before(scene, s, sigma_t, tau, before);
#if BRUME_MEDIA == 2
  float others[TAU_CHANNELS][W];
  for (int i = 0; i < W; ++i) {
    tau_t here = (tau_t)(0.0f);
    if (s->integral[i] > 0.0f) here = stretch_others(scene, s, m, i, result);
    for (int c = 0; c < TAU_CHANNELS; ++c) others[c][i] = tau_channel(here, c);
  }
  for (int c = 0; c < TAU_CHANNELS; ++c) before[c] += lanes_load(others[c]);
#endif
  const floatW integral = lanes_load(s->integral);
  for (int c = 0; c < TAU_CHANNELS; ++c) s->gain[c] = segment_gain(scene, tau_channel(sigma_t, c), integral, before[c]);
}

#if BRUME_TRACKING
// The same for tentative collisions: without bias in the mean, whatever the light.
static inline void track_gains(const Scene* scene, Stretch* s, int m, tau_t sigma_t, tau_t* tau, MediumResult* result) {
  float gain[TAU_CHANNELS][W];
  for (int c = 0; c < TAU_CHANNELS; ++c)
    for (int i = 0; i < W; ++i) gain[c][i] = 0.0f;
  for (int i = 0; i < s->at->count; ++i) {
    const Collision hit = track_collide(s->medium, &s->walk, s->at, i, s->integral[i], sigma_t, tau);
    if (hit.weight > 0.0f) {
      const tau_t before = hit.before + stretch_others(scene, s, m, i, result);
      for (int c = 0; c < TAU_CHANNELS; ++c) gain[c][i] = hit.weight * exp(-tau_channel(before, c));
    }
    s->integral[i] = hit.weight;
    result->lookups += s->at->size[i] > 0.0f;
    if (!roulette_survives(scene, &s->walk, s->at->id[i], tau) || tau_min(*tau) >= TAU_STOP) {
      stretch_cut(s, i + 1);
      break;
    }
  }
  for (int c = 0; c < TAU_CHANNELS; ++c) s->gain[c] = lanes_load(gain[c]);
}
#endif

// Medium m along a view ray up to t_max: adds what it scatters and emits towards the origin to *radiance and returns its
// optical depth.
static inline tau_t medium_scatter(const Scene* scene, int m, float3 origin, float3 dir, float t_max, Random random,
                                   float3* radiance, MediumResult* result) {
  const Medium medium = scene->media[m];
  const tau_t sigma_t = medium_sigma_t(&medium);
  const MediumRay ray = medium_ray(&medium, origin, dir, t_max);
  tau_t tau = (tau_t)(0.0f);
  if (!(ray.length > 0.0f)) return tau;
  Segments at;
  Stretch stretch;
  stretch.medium = &medium;
  stretch.ray = &ray;
  stretch.at = &at;
  stretch.origin = origin;
  stretch.dir = dir;
  stretch.walk = random_stream(random, (uint)m);
  Walk walk = walk_begin(&medium, &ray, stretch.walk, 0);
  for (walk_next(scene, &medium, &ray, &walk, &at); at.count > 0 && tau_min(tau) < TAU_STOP;
       walk_next(scene, &medium, &ray, &walk, &at)) {
    lanes_store(walk_integral(scene, &medium, &ray, &at), stretch.integral);
#if BRUME_TRACKING
    if (METHOD_TRACKS(&medium)) {
      track_gains(scene, &stretch, m, sigma_t, &tau, result);
    } else
#endif
    {
      result->lookups += walk_lookups(&medium, &at);
      stretch_gains(scene, &stretch, m, sigma_t, &tau, result);
    }
    *radiance += stretch_radiance(scene, &stretch, result);
  }
  return tau;
}

// All media along a view ray.
static inline MediumResult media_scatter(const Scene* scene, float3 origin, float3 dir, float t_max, Random random) {
  MediumResult result;
  result.lookups = 0;
  result.shadow_key = 0;
  result.shadow_rays = 0;
  result.secondary_rays = 0;
  result.pad[0] = result.pad[1] = 0;
  float3 radiance = (float3)(0.0f);
  tau_t tau = (tau_t)(0.0f);
#if BRUME_MEDIA
  for (int m = 0; m < MEDIA_END(scene); ++m)
    tau += medium_scatter(scene, m, origin, dir, t_max, random, &radiance, &result);
#endif
  result.transmittance = vec_pack((float3)(1.0f) * exp(-tau));
  result.radiance = vec_pack(radiance);
  return result;
}

#endif
