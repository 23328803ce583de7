// The light that reaches the segments of a stretch: S = Σ over lights of E · V · T · p.
#ifndef BRUME_MEDIA_SOURCES_CL
#define BRUME_MEDIA_SOURCES_CL
#include "lights/lights.cl"
#include "materials/glass.cl"
#include "media/ladder.cl"
#include "media/light_grid.cl"
#include "phase/phase.cl"

// RGB of every lane.
typedef struct {
  floatW x, y, z;
} Colors;

// Mean of the light's transmittance over a segment whose own depth is `depth`, weighted as the view sees it. Both
// depths grow evenly, that to the light from `begin` to `end`: ∫ exp(-t) over the sum of both, by ∫ exp(-t) over the
// own (PICTURE, Dense segments).
static inline floatW lanes_light_mean(floatW begin, floatW end, floatW depth) {
  const floatW last = fmin(depth + end, (floatW)(TAU_FINITE)), first = fmin(begin, (floatW)(TAU_FINITE));
  const floatW nearer = fmin(first, last), span = fabs(last - first);
  return exp(-nearer) * lanes_mean_exp(span) / lanes_mean_exp(depth);
}

static inline float mean_exp(float x) { return x < 1e-4f ? 1.0f - 0.5f * x : one_minus_exp(x) / x; }

static inline float light_mean(float begin, float end, float depth) {
  const float last = fmin(depth + end, TAU_FINITE), first = fmin(begin, TAU_FINITE);
  return exp(-fmin(first, last)) * mean_exp(fabs(last - first)) / mean_exp(depth);
}

// Light l at a place: E · V · p, and V into the key. 0 when nothing arrives.
OUTLINED float3 place_arriving(const Scene* scene, const Stretch* s, int l, float place, MediumResult* result) {
  const float3 point = vec_point(s->origin, s->dir, s->ray->t_begin + place);
  const LightSample light = light_sample(scene, l, point, s->random);
  if (!(vec_max(light.irradiance) > 0.0f)) return (float3)(0.0f);
  ++result->shadow_rays;
  const float3 passes = light_passes(scene, point, -light.travel, light.reach, 0.0f);
  if (!(vec_max(passes) > 0.0f)) {
    result->shadow_key += (uint)(l + 1);
    return (float3)(0.0f);
  }
  return passes * light.irradiance * phase_eval(s->medium->phase, s->medium->g, light.travel, -s->dir);
}

#if BRUME_LIGHT_GRID
// Light l at all segments: E · V · p.
static inline Colors stretch_arriving(const Scene* scene, const Stretch* s, int l, MediumResult* result) {
  Colors out;
#if !HAS_SURFACES
  if (USES_LIGHT(DIRECTIONAL) && scene->lights[l].type == LIGHT_DIRECTIONAL) {  // the same everywhere
    const float3 arriving = place_arriving(scene, s, l, s->at->place[0], result);
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
    if (s->integral[i] > 0.0f) arriving = place_arriving(scene, s, l, s->at->place[i], result);
    x[i] = arriving.x;
    y[i] = arriving.y;
    z[i] = arriving.z;
  }
  out.x = lanes_load(x);
  out.y = lanes_load(y);
  out.z = lanes_load(z);
  return out;
}

// T of each segment to the light of a grid.
static inline void transmittance_from_grid(const Scene* scene, const Stretch* s, const LightGrid* grid, floatW* t,
                                           MediumResult* result) {
  const floatW place = lanes_load(s->at->place), begin = lanes_load(s->at->begin);
  const int ends = lanes_any(s->dense);
  floatW from[2] = {lanes_select(place, begin, s->dense),
                    lanes_select(place, begin + lanes_load(s->at->size), s->dense)};
  floatW tau[2][TAU_CHANNELS];
  for (int end = 0; end < 1 + ends; ++end) {
    const LightGridPlace at = light_grid_place(grid, s->ray, from[end]);
    for (int c = 0; c < TAU_CHANNELS; ++c) tau[end][c] = light_grid_tau(grid, scene->light_tau, &at, c);
    result->lookups += (uint)s->at->count;
  }
  for (int c = 0; c < TAU_CHANNELS; ++c) {
    t[c] = exp(-tau[0][c]);
    if (ends) t[c] = lanes_select(t[c], lanes_light_mean(tau[0][c], tau[1][c], s->depth[c]), s->dense);
  }
}

static inline Colors sources_from_grid(const Scene* scene, const Stretch* s, MediumResult* result) {
  Colors sum = {(floatW)(0.0f), (floatW)(0.0f), (floatW)(0.0f)};
  for (int l = 0; l < scene->frame->light_count; ++l) {
    const LightGrid grid = scene->light_grids[s->medium->light_grids + l];
    floatW t[TAU_CHANNELS];
    transmittance_from_grid(scene, s, &grid, t, result);
    const Colors arriving = stretch_arriving(scene, s, l, result);
    sum.x += arriving.x * t[0];
    sum.y += arriving.y * t[TAU_CHANNELS / 2];
    sum.z += arriving.z * t[TAU_CHANNELS - 1];
  }
  return sum;
}
#endif

// T of segment i to the light of shadow ray n. A dense segment asks at both ends, from END_INSET inside of them, and
// goes on from there in a straight line. One begins where the one before ended: with one light the depth there is
// known.
static inline float3 transmittance_traced(const Scene* scene, Stretch* s, int l, int n, int i, int dense,
                                          const float* depth, MediumResult* result) {
  const float size = s->at->size[i];
#if BRUME_RANDOM
  const int known = 0;
#else
  const int known = dense && scene->frame->light_count == 1 && !segment_is_on_ladder(s, i) &&
                    fabs(stretch_begin(s, i) - s->light_t) <= 0x1p-10f * size;
#endif
  const float share[2] = {known ? 0.0f : END_INSET, 1.0f - END_INSET};
  Tau tau[2] = {s->light_tau, s->light_tau};
  for (int e = known; e < 1 + dense; ++e) {
    const float place = dense ? mad_exact(share[e], size, s->at->begin[i]) : s->at->place[i];
    const Random random = stretch_random(s, i, (e ? STREAM_LIGHT_END : STREAM_LIGHT) + (uint)n);
    tau[e] = segment_light_depth(scene, s, l, i, place, random, &result->lookups);
  }
  if (!dense) return (float3)(1.0f) * exp(-tau[0]);
  tau[0] = fmin(tau[0], (Tau)(TAU_FINITE));
  tau[1] = fmin(tau[1], (Tau)(TAU_FINITE));
  const Tau slope = (tau[1] - tau[0]) / (share[1] - share[0]);
  const Tau begin = fmax(tau[0] - slope * share[0], (Tau)(0.0f));
  s->light_tau = fmax(tau[1] + slope * END_INSET, (Tau)(0.0f));
  s->light_t = segment_is_on_ladder(s, i) ? -INFINITY : stretch_end(s, i);  // one that asks for itself asks again
  float mean[3];
  for (int c = 0; c < TAU_CHANNELS; ++c)
    mean[c] = light_mean(tau_channel(begin, c), tau_channel(s->light_tau, c), depth[c * W + i]);
  return (float3)(mean[0], mean[TAU_CHANNELS / 2], mean[TAU_CHANNELS - 1]);
}

static inline Colors sources_traced(const Scene* scene, Stretch* s, MediumResult* result) {
  float x[W], y[W], z[W], depth[TAU_CHANNELS * W];
  int dense[W];
  lanes_store(s->dense, dense);
  for (int c = 0; c < TAU_CHANNELS; ++c) lanes_store(s->depth[c], depth + c * W);
  for (int i = 0; i < W; ++i) {
    float3 sum = (float3)(0.0f);
    const float xi = light_choice(s->walk, stretch_id(s, i));
    for (int n = 0; n < scene->frame->light_picks; ++n) {
      if (!(s->integral[i] > 0.0f)) continue;
      const LightPick pick = light_choose(scene, n, xi);
      const float3 arriving = pick.weight * place_arriving(scene, s, pick.light, s->at->place[i], result);
      if (!(vec_max(arriving) > 0.0f)) continue;
      sum += arriving * transmittance_traced(scene, s, pick.light, n, i, dense[i] != 0, depth, result);
    }
    x[i] = sum.x;
    y[i] = sum.y;
    z[i] = sum.z;
  }
  const Colors out = {lanes_load(x), lanes_load(y), lanes_load(z)};
  return out;
}

#endif
