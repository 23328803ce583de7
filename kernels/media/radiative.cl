// From ∫ρ to light: what one medium scatters along a view ray, behind the others.
#ifndef BRUME_MEDIA_RADIATIVE_CL
#define BRUME_MEDIA_RADIATIVE_CL
#include "media/lit_steps.cl"
#include "media/runs.cl"

// What medium m sends to the origin from these segments. lit: not by runs, which have taken their light.
static inline float3 stretch_radiance(const Scene* scene, Stretch* s, int lit, MediumResult* result) {
  const float3 sigma_s = vec_unpack(s->medium->sigma_s), emission = vec_unpack(s->medium->emission);
  Colors source = {(floatW)(0.0f), (floatW)(0.0f), (floatW)(0.0f)};
  if (lit && vec_max(sigma_s) > 0.0f) source = stretch_sources(scene, s, result);
  return (float3)(lanes_sum((source.x * sigma_s.x + emission.x) * s->gain[0]),
                  lanes_sum((source.y * sigma_s.y + emission.y) * s->gain[TAU_CHANNELS / 2]),
                  lanes_sum((source.z * sigma_s.z + emission.z) * s->gain[TAU_CHANNELS - 1]));
}

// No light is asked for from segment i on.
static inline void stretch_end_at(Stretch* s, int i) {
  for (; i < W; ++i) s->integral[i] = 0.0f;
}

// ∫ρT over segments behind `before`: while T falls by `depth`, evenly with ∫ρ, it is ∫ρ times the mean of T.
static inline floatW segment_gain(const Scene* scene, const Medium* medium, floatW integral, floatW before,
                                  floatW depth) {
  if (SUMS_BY(scene, medium, RECTANGLE)) return exp(-(before + depth)) * integral;
  if (METHOD_IS(medium, ADAPTIVE)) integral = lanes_select(integral, (floatW)(0.0f), before > medium->tau_lit);
  return exp(-before) * lanes_mean_exp(depth) * integral;
}

// τ of the medium up to each segment; moves *tau past them all.
static inline void stretch_before(const Scene* scene, Stretch* s, Tau sigma_t, Tau* tau, floatW* before) {
#if BRUME_ROULETTE
  float each[TAU_CHANNELS][W];
  for (int i = 0; i < W; ++i) {
    for (int c = 0; c < TAU_CHANNELS; ++c) each[c][i] = tau_channel(*tau, c);
    *tau += sigma_t * s->integral[i];
    if (s->integral[i] > 0.0f && !roulette_survives(scene, &s->walk, s->id[i], tau)) stretch_end_at(s, i + 1);
  }
  for (int c = 0; c < TAU_CHANNELS; ++c) before[c] = lanes_load(each[c]);
#else
  const floatW integral = lanes_load(s->integral);
  if (RULE_IS(s->medium, PRODUCT)) {  // no sum over many steps, each of which would round it
    const floatW walked = s->medium->constant_density * lanes_load(s->at->begin);
    for (int c = 0; c < TAU_CHANNELS; ++c) before[c] = tau_channel(sigma_t, c) * walked;
    const int last = s->at->count - 1;
    *tau = sigma_t * (s->medium->constant_density * (s->at->begin[last] + s->at->size[last]));
    return;
  }
  const floatW walked = lanes_before(integral);
  for (int c = 0; c < TAU_CHANNELS; ++c)
    before[c] = mad_exact((floatW)(tau_channel(sigma_t, c)), walked, (floatW)(tau_channel(*tau, c)));
  *tau += sigma_t * lanes_sum(integral);
#endif
}

// Gains of the segments; moves *tau, that of their medium, past them.
static inline void stretch_gains(const Scene* scene, Stretch* s, Tau sigma_t, Tau* tau) {
  floatW before[TAU_CHANNELS];
  s->dense = (intW)(0);
  if (TAKES_ENDS(scene) && SUMS_BY(scene, s->medium, SEGMENT))
    s->dense = stretch_depth_max(s) > (floatW)(IS_PRODUCT(s->medium) ? TAU_THIN_CONSTANT : TAU_THIN);
  if (TAKES_ENDS(scene) && SUMS_BY(scene, s->medium, GAUSS2)) s->dense = stretch_deep(s);
  stretch_before(scene, s, sigma_t, tau, before);
  const floatW integral = lanes_load(s->integral);
  for (int c = 0; c < TAU_CHANNELS; ++c) {
#if BRUME_MEDIA >= 2
    before[c] += s->others[c];
#endif
    s->gain[c] = segment_gain(scene, s->medium, integral, before[c], s->depth[c]);
  }
}

#if BRUME_TRACKING
// The same for tentative collisions: without bias in the mean, whatever the light.
static inline void track_gains(const Scene* scene, Stretch* s, int m, Tau sigma_t, Tau* tau, Others* others,
                               MediumResult* result) {
  float gain[TAU_CHANNELS][W];
  s->dense = (intW)(0);
  for (int c = 0; c < TAU_CHANNELS; ++c)
    for (int i = 0; i < W; ++i) gain[c][i] = 0.0f;
  for (int i = 0; i < s->at->count; ++i) {
    const Collision hit = track_collide(s->medium, &s->walk, s->at, i, s->integral[i], sigma_t, tau);
    if (hit.weight > 0.0f) {
#if BRUME_MEDIA >= 2
      others_advance(scene, s, m, s->at->place[i], stretch_random(s, i, STREAM_OTHERS), others, &result->lookups);
#endif
      const Tau before = hit.before + others->tau;
      for (int c = 0; c < TAU_CHANNELS; ++c) gain[c][i] = hit.weight * exp(-tau_channel(before, c));
    }
    s->integral[i] = hit.weight;
    result->lookups += s->at->size[i] > 0.0f;
    if (!roulette_survives(scene, &s->walk, s->at->id[i], tau) || tau_min(*tau) >= TAU_STOP) {
      stretch_end_at(s, i + 1);
      break;
    }
  }
  for (int c = 0; c < TAU_CHANNELS; ++c) s->gain[c] = lanes_load(gain[c]);
}
#endif

// What the pieces of a walk may err by, in ∫ρ: sums of squares, as they are and as they are seen; and ∫ρT.
typedef struct {
  float squares, seen, gain;
} Rough;

static inline void stretch_rough(const Scene* scene, const Stretch* s, Rough* rough) {
  const Segments* at = s->at;
  const float cells = length(s->ray->dir);
  float gain[W];
  lanes_store(s->gain[TAU_CHANNELS / 2], gain);
  for (int i = 0; i < W; ++i) {
    if (!(s->integral[i] > 0.0f)) continue;
    rough->gain += gain[i];
    if (s->medium->is_constant) continue;
    const int brick = (at->base[i] + brick_stride((int)at->x[i], (int)at->y[i], (int)at->z[i])) / BRICK_VALUES;
    const float square = piece_row(scene, s->medium, brick, PIECE_ROUGH) * cells * at->size[i];
    const float passed = gain[i] / s->integral[i];
    rough->squares += square;
    rough->seen += square * passed * passed;
  }
}

// `sent`: what the medium sends to the origin, mean of the channels.
static inline void rough_tell(const Rough* rough, Tau sigma_t, float sent, MediumResult* result) {
  if (rough->gain > 0.0f) result->error += fabs(sent) * sqrt(rough->seen) / rough->gain;
  const float depth = tau_max(sigma_t) * sqrt(rough->squares);
  result->tau_error = sqrt(result->tau_error * result->tau_error + depth * depth);
}

static inline Stretch stretch_of(const Medium* medium, const MediumRay* ray, float3 origin, float3 dir, float t_max,
                                 Random random, int m) {
  Stretch s;
  s.medium = medium;
  s.ray = ray;
  s.origin = origin;
  s.dir = dir;
  s.t_max = t_max;
  s.random = random;
  s.walk = random_stream(random, (uint)m);
  s.kinks = 0;
#if BRUME_MEDIA >= 3
  s.ladder = 0;
#endif
  s.light_t = -INFINITY;
  s.light_tau = (Tau)(0.0f);
  return s;
}

// Medium m along a view ray up to t_max: adds what it scatters and emits towards the origin to *radiance and returns
// its optical depth. Each turn takes W segments of the walk, or W parts of those that are dense.
static inline Tau medium_scatter(const Scene* scene, int m, float3 origin, float3 dir, float t_max, Random random,
                                 LongSum* radiance, MediumResult* result) {
  const Medium medium = scene->media[m];
  const Tau sigma_t = medium_sigma_t(&medium);
  const MediumRay ray = medium_ray(&medium, origin, dir, t_max);
  Tau tau = (Tau)(0.0f);
  if (!(ray.length > 0.0f)) return tau;
  const int cuts = !SUMS_BY(scene, &medium, RECTANGLE);
  Stretch s = stretch_of(&medium, &ray, origin, dir, t_max, random, m);
  Others others = {-ray.t_begin, (Tau)(0.0f)};
  Segments whole, parts;
  Cut cut;
  cut.lane = W;
  Walk walk = walk_begin(scene, &medium, &ray, s.walk, WALK_SCATTERS);
  const int lit_steps = SUMS_BY(scene, &medium, GAUSS2) && IS_PRODUCT(&medium);
  const int runs = METHOD_IS(&medium, ADAPTIVE) && medium.light_grids < 0 && LIGHTS_ALL(scene) &&
                   vec_max(vec_unpack(medium.sigma_s)) > 0.0f;
  Run run;
  run.count = 0;
  run.faint = 0.0f;
  run.seen = radiance->sum.x + radiance->sum.y + radiance->sum.z;
  const float before = vec_mean(radiance->sum);
  Rough rough = {0.0f, 0.0f, 0.0f};
  Kinks kinks;
  if (HAS_LIGHT_KINKS(scene, &medium)) {
    kinks_begin(&kinks, 0.0f, ray.length);
    kinks_of_lights(scene, &s, &kinks);
    s.kinks = &kinks;
  }
  LitSteps lit;
  if (lit_steps) lit = lit_steps_begin(scene, &s, m);
  while (tau_min(tau + others.tau) < TAU_STOP) {
    const int uncut = cut.lane == W;
    if (uncut) {
      if (lit_steps)
        lit_steps_fill(scene, &s, &lit, &whole);
      else
        walk_next(scene, &medium, &ray, &walk, &whole);
      s.at = &whole;
    } else {
      stretch_parts(&whole, &cut, &parts, &s);
      s.at = &parts;
    }
    if (s.at->count == 0) {
      if (uncut) break;
      continue;  // the last parts filled their batch
    }
#if BRUME_RANDOM
    for (int i = 0; i < W; ++i) s.id[i] = uncut ? walk_id(&medium, &whole, i) : parts.id[i];
#endif
    if (uncut || RULE_IS(&medium, GAUSS2) || RULE_IS(&medium, PIECE)) {
      lanes_store(SUMS_BY(scene, &medium, GAUSS2) ? walk_integral_shares(scene, &medium, &ray, s.at, &s.second)
                                                  : walk_integral(scene, &medium, &ray, s.at),
                  s.integral);
      if (!PLACEMENT_IS(&medium, COLLISIONS)) result->lookups += walk_lookups(&medium, s.at);
    }
#if BRUME_TRACKING
    if (PLACEMENT_IS(&medium, COLLISIONS)) {
      track_gains(scene, &s, m, sigma_t, &tau, &others, result);
    } else
#endif
    {
      Others moved = others;
#if BRUME_MEDIA >= 2
      stretch_others(scene, &s, m, m + 1, &moved, &result->lookups);
#endif
      stretch_depths(&s, sigma_t);
      if (uncut && cuts && stretch_cut(scene, &s, &cut)) continue;
      others = moved;
      stretch_gains(scene, &s, sigma_t, &tau);
      if (METHOD_IS(&medium, ADAPTIVE)) stretch_rough(scene, &s, &rough);
    }
    int lit = 1;
    if (runs) {  // but what is dense still asks for itself
      run_take(scene, &s, &run, radiance, result);
      lanes_store(lanes_select((floatW)(0.0f), lanes_load(s.integral), s.dense), s.integral);
      lit = lanes_any(s.dense);
    }
    long_sum_add(radiance, stretch_radiance(scene, &s, lit, result));
  }
  if (runs && run.count > 0) long_sum_add(radiance, run_shine(scene, &s, &run, result));
  if (METHOD_IS(&medium, ADAPTIVE)) rough_tell(&rough, sigma_t, vec_mean(radiance->sum) - before, result);
  return tau;
}

#endif
