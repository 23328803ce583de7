// One light along a run of points of `adaptive`: some are asked for how much of it gets through to them, the others
// read that from parabolas (PICTURE, Runs).
#ifndef BRUME_MEDIA_RUN_LIGHT_CL
#define BRUME_MEDIA_RUN_LIGHT_CL
#include "media/two_points.cl"

#define RUN_POINTS 64               // of 32 segments
#define RUN_SPAN 4                  // points from one that is asked to the next: no parabola is longer
#define RUN_DEPTH 4                 // of intervals that are cut into halves: 2^(RUN_DEPTH - 2) >= RUN_SPAN
#define RUN_WIDE (33.0f / 1024.0f)  // of the ray's way through the medium: no whole number of equal steps
#define RUN_FAINT 0.25f             // of the tolerance: points that could send no more than that are not asked

typedef struct {
  int count;
  float place[RUN_POINTS];               // s, ascending
  float gain[TAU_CHANNELS][RUN_POINTS];  // ∫ρT that each point stands for
#if BRUME_RANDOM
  uint id[RUN_POINTS];
#endif
  float seen;   // light that the ray got so far: sum over channels
  float faint;  // what lights would have sent that were not asked
} Run;

// One light at the points of a run.
typedef struct {
  int first, last;                         // points that it may reach
  float weight[3][RUN_POINTS];             // what each sends to the origin if nothing is in the way, per colour
  float upto[TAU_CHANNELS][RUN_POINTS];    // sum of the weights up to each, it included
  float passed[TAU_CHANNELS][RUN_POINTS];  // V · T of what is known
  int lit[RUN_POINTS];                     // V ≠ 0; -1 of those that were not asked
} RunLight;

#define RUN_COLOR(color) (TAU_CHANNELS == 1 ? 0 : (color))

// σs · E · p of light l at a point of the run.
static inline float3 run_arriving(const Scene* scene, const Stretch* s, const Run* run, int l, int i) {
  const float3 point = vec_point(s->origin, s->dir, s->ray->t_begin + run->place[i]);
  const LightSample light = light_sample(scene, l, point, s->random);
  if (!(vec_max(light.irradiance) > 0.0f)) return (float3)(0.0f);
  return vec_unpack(s->medium->sigma_s) * light.irradiance *
         phase_eval(s->medium->phase, s->medium->g, light.travel, -s->dir);
}

// Light l at all points, unblocked; of a directional one E and p are the same everywhere. 0: it reaches none.
static inline int run_weigh(const Scene* scene, const Stretch* s, const Run* run, int l, RunLight* out) {
  const int same = USES_LIGHT(DIRECTIONAL) && scene->lights[l].type == LIGHT_DIRECTIONAL;
  float3 arriving = run_arriving(scene, s, run, l, 0);
  float sum[TAU_CHANNELS];
  for (int c = 0; c < TAU_CHANNELS; ++c) sum[c] = 0.0f;
  out->first = run->count;
  out->last = -1;
  for (int i = 0; i < run->count; ++i) {
    out->lit[i] = -1;
    if (!same && i > 0) arriving = run_arriving(scene, s, run, l, i);
    const float3 weight =
        arriving * (float3)(run->gain[0][i], run->gain[TAU_CHANNELS / 2][i], run->gain[TAU_CHANNELS - 1][i]);
    out->weight[0][i] = weight.x;
    out->weight[1][i] = weight.y;
    out->weight[2][i] = weight.z;
    sum[0] += weight.x;
    sum[RUN_COLOR(1)] += weight.y;
    sum[RUN_COLOR(2)] += weight.z;
    for (int c = 0; c < TAU_CHANNELS; ++c) out->upto[c][i] = sum[c];
    if (!(vec_max(weight) > 0.0f)) continue;
    out->first = min(out->first, i);
    out->last = i;
  }
  return out->last >= 0;
}

// V of light l at a place.
OUTLINED float3 run_surfaces(const Scene* scene, const Stretch* s, int l, float place, MediumResult* result) {
  const float3 point = vec_point(s->origin, s->dir, s->ray->t_begin + place);
  const LightSample sample = light_sample(scene, l, point, s->random);
  ++result->shadow_rays;
  return light_passes(scene, point, -sample.travel, sample.reach, 0.0f);
}

// V · T of light l at point i.
static inline void run_ask(const Scene* scene, const Stretch* s, const Run* run, int l, int i, RunLight* light,
                           MediumResult* result) {
  const float t = s->ray->t_begin + run->place[i];
  const float3 point = vec_point(s->origin, s->dir, t);
  const LightSample sample = light_sample(scene, l, point, s->random);
#if BRUME_RANDOM
  const Random random =
      random_stream(random_stream(s->walk, run->id[i]), (i & 1 ? STREAM_LIGHT_END : STREAM_LIGHT) + (uint)l);
#else
  const Random random = s->walk;
#endif
  Tau passed = (Tau)(0.0f);
  const float3 surfaces = run_surfaces(scene, s, l, run->place[i], result);
  light->lit[i] = vec_max(surfaces) > 0.0f;
  if (!light->lit[i])
    result->shadow_key += (uint)(l + 1);
  else
    passed = TAU_OF_COLOR(surfaces) *
             exp(-media_tau(scene, -1, point, -sample.travel, sample.distance, random, &result->lookups));
  for (int c = 0; c < TAU_CHANNELS; ++c) light->passed[c][i] = tau_channel(passed, c);
}

static inline float slope_between(float a, float b, float from, float to) {
  return to > from ? (b - a) / (to - from) : 0.0f;
}

// Weight of what lies between two points.
static inline float run_between(const RunLight* light, int c, int a, int b) {
  return light->upto[c][b - 1] - light->upto[c][a];
}

// Whether the points between a and b send so little that nobody has to be asked.
static inline int run_is_faint(const Run* run, const RunLight* light, int a, int b, float tolerance) {
  if (b - a < 2) return 1;
  float most = 0.0f;
  for (int c = 0; c < TAU_CHANNELS; ++c) most += run_between(light, c, a, b);
  return !(most > tolerance * RUN_FAINT * run->seen);
}

// By how much light at m, between a and b, is off the straight line: what the points between them send with it.
static inline float run_bend(const Run* run, const RunLight* light, int a, int m, int b) {
  float off = 0.0f;
  const float share = (run->place[m] - run->place[a]) / fmax(run->place[b] - run->place[a], 1e-30f);
  for (int c = 0; c < TAU_CHANNELS; ++c) {
    const float near = light->passed[c][a], line = mad_exact(share, light->passed[c][b] - near, near);
    off += run_between(light, c, a, b) * fabs(light->passed[c][m] - line);
  }
  return off;
}

// About what they send, and what the ray has got before.
static inline float run_sent(const Run* run, const RunLight* light, int a, int m, int b) {
  float sum = run->seen;
  for (int c = 0; c < TAU_CHANNELS; ++c) {
    const float* passed = light->passed[c];
    sum += run_between(light, c, a, b) * (0.25f * (passed[a] + passed[b]) + 0.5f * passed[m]);
  }
  return sum;
}

// Whether a shadow may lie between a and b that none of the points that are asked would see.
static inline int run_is_wide(const Scene* scene, const Stretch* s, const Run* run, int a, int b) {
  return scene_has_surfaces(scene) && run->place[b] - run->place[a] > RUN_WIDE * s->ray->length;
}

// Fills in the points between a and b by the parabola through m, which is one of them; without one (m = a) by a line.
static inline void run_fill(const Run* run, int a, int m, int b, RunLight* light) {
  const float from = run->place[a], over = run->place[m], to = run->place[b];
  for (int c = 0; c < TAU_CHANNELS; ++c) {
    float* passed = light->passed[c];
    const float line = slope_between(passed[a], passed[b], from, to);
    const float first = m > a ? slope_between(passed[a], passed[m], from, over) : line;
    const float turn = m > a ? slope_between(first, slope_between(passed[m], passed[b], over, to), from, to) : 0.0f;
    for (int i = a + 1; i < b; ++i) {
      const float s = run->place[i];
      if (i != m) passed[i] = fmin(fmax(mad_exact(s - from, mad_exact(s - over, turn, first), passed[a]), 0.0f), 1.0f);
    }
  }
}

// What gets through of light l to all points that it may reach: asks at intervals of RUN_SPAN points, or at both ends
// where all between is faint, and in an interval where it bends. One call of run_ask: every call site is compiled anew.
static inline void run_pass(const Scene* scene, const Stretch* s, const Run* run, int l, RunLight* light,
                            MediumResult* result) {
  const float tolerance = s->medium->tolerance;
  const int span = run_is_faint(run, light, light->first, light->last, tolerance) ? RUN_POINTS : RUN_SPAN;
  int ends[RUN_DEPTH], depth = 0, known = -1, middle = 0, ask = light->first;
  for (;;) {
    run_ask(scene, s, run, l, ask, light, result);
    const int tests = known >= 0 && middle;
    const float off = tests ? run_bend(run, light, known, ask, ends[depth - 1]) : 0.0f;
    if (known < 0) {
      known = ask;
    } else if (!tests || run_is_wide(scene, s, run, known, ends[depth - 1]) ||
               off > tolerance * run_sent(run, light, known, ask, ends[depth - 1])) {
      ends[depth++] = ask;
    } else {
      result->error += (1.0f / 3.0f) * off;
      run_fill(run, known, ask, ends[depth - 1], light);
      known = ends[--depth];
    }
    while (depth > 0 && run_is_faint(run, light, known, ends[depth - 1], tolerance)) {
      run_fill(run, known, known, ends[depth - 1], light);
      known = ends[--depth];
    }
    middle = depth > 0;
    if (!middle && known == light->last) return;
    ask = middle ? (known + ends[depth - 1]) / 2 : min(known + span, light->last);
  }
}

#if HAS_SURFACES
// Half of the segment of point i, and where the share of it for which the point stands begins.
static inline float run_half(const Run* run, int i, float* begin) {
  const int first = i & ~1;
  const float apart = run->place[first + 1] - run->place[first], extent = apart * (0.5f / BETWEEN_POINTS);
  const float middle = 0.5f * (run->place[first] + run->place[first + 1]);
  *begin = first == i ? middle - extent : middle;
  return extent;
}

// Share of the light of point i up to s.
static inline float run_share(const Run* run, int i, float s) {
  float begin;
  const float extent = run_half(run, i, &begin);
  return extent > 0.0f ? fmin(fmax((s - begin) / extent, 0.0f), 1.0f) : 0.0f;
}

// Where between two points that follow each other the first is lit and the other is not, or the other way round.
static inline float run_edge(const Scene* scene, const Stretch* s, const Run* run, int l, int i, int lit,
                             MediumResult* result) {
  float near = run->place[i], far = run->place[i + 1];
  for (int halving = 0; halving < EDGE_HALVINGS; ++halving) {
    const float middle = 0.5f * (near + far);
    if ((vec_max(run_surfaces(scene, s, l, middle, result)) > 0.0f) == lit)
      near = middle;
    else
      far = middle;
  }
  return 0.5f * (near + far);
}

// Moves the light of points on the two sides of an edge to where it lies.
static inline void run_edges(const Scene* scene, const Stretch* s, const Run* run, int l, RunLight* light,
                             MediumResult* result) {
  const float faint = s->medium->tolerance * RUN_FAINT * run->seen;
  float here[TAU_CHANNELS], next[TAU_CHANNELS];
  for (int c = 0; c < TAU_CHANNELS; ++c) next[c] = light->passed[c][light->first];
  for (int i = light->first; i < light->last; ++i) {
    float sent = 0.0f;
    for (int c = 0; c < TAU_CHANNELS; ++c) {
      here[c] = next[c];
      next[c] = light->passed[c][i + 1];
      const float before = i > 0 ? light->upto[c][i - 1] : 0.0f;
      sent += (light->upto[c][i + 1] - before) * (here[c] + next[c]);
    }
    if (light->lit[i] < 0 || light->lit[i + 1] < 0 || light->lit[i] == light->lit[i + 1] || !(sent > faint)) continue;
    const float edge = run_edge(scene, s, run, l, i, light->lit[i], result);
    const float first = run_share(run, i, edge), second = run_share(run, i + 1, edge);
    for (int c = 0; c < TAU_CHANNELS; ++c) {  // of the light of the one that is lit
      light->passed[c][i] += here[c] * (first - 1.0f) + next[c] * (1.0f - first);
      light->passed[c][i + 1] += here[c] * second - next[c] * second;
    }
  }
}
#endif

#endif
