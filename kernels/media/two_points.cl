// The rule `gauss2`: light at two points of each segment (PICTURE, Two points); and which rule a segment takes.
#ifndef BRUME_MEDIA_TWO_POINTS_CL
#define BRUME_MEDIA_TWO_POINTS_CL
#include "media/sources.cl"

#define FIRST_POINT 0.211324865405187f   // (1 - 1/√3) / 2 of the segment
#define SECOND_POINT 0.788675134594813f  // and as far from its end
#define BETWEEN_POINTS 0.577350269189626f

// What one shadow ray of each segment brings to one of its points: E · V · p and the depth on the way.
typedef struct {
  float light[3][W];  // 0 where nothing arrives; the depth is not asked for then
  float tau[TAU_CHANNELS][W];
} Arrivals;

// Shadow ray n of each segment to the light from `place`.
static inline void arrivals_find(const Scene* scene, const Stretch* s, int n, const float* place, uint stream,
                                 Arrivals* out, MediumResult* result) {
  for (int i = 0; i < W; ++i) {
    float3 arriving = (float3)(0.0f);
    Tau tau = (Tau)(0.0f);
    if (s->integral[i] > 0.0f) {
      const LightPick pick = light_choose(scene, n, light_choice(s->walk, stretch_id(s, i)));
      arriving = pick.weight * place_arriving(scene, s, pick.light, place[i], result);
      if (vec_max(arriving) > 0.0f && !(BRUME_LIGHT_GRID && s->medium->light_grids >= 0))
        tau = light_depth(scene, s, pick.light, s->ray->t_begin + place[i], stretch_random(s, i, stream + (uint)n),
                          &result->lookups);
    }
    out->light[0][i] = arriving.x;
    out->light[1][i] = arriving.y;
    out->light[2][i] = arriving.z;
    for (int c = 0; c < TAU_CHANNELS; ++c) out->tau[c][i] = fmin(tau_channel(tau, c), TAU_FINITE);
  }
#if BRUME_LIGHT_GRID
  if (s->medium->light_grids < 0) return;
  const LightGrid grid = scene->light_grids[s->medium->light_grids + n];
  const LightGridPlace at = light_grid_place(&grid, s->ray, lanes_load(place));
  for (int c = 0; c < TAU_CHANNELS; ++c) lanes_store(light_grid_tau(&grid, scene->light_tau, &at, c), out->tau[c]);
  result->lookups += (uint)s->at->count;
#endif
}

static inline intW arrivals_lit(const Arrivals* a) {
  return (lanes_load(a->light[0]) > 0.0f) | (lanes_load(a->light[1]) > 0.0f) | (lanes_load(a->light[2]) > 0.0f);
}

// The share of a segment before its first point: that of Gauss's rule, or where it is dense still next to nothing.
static inline floatW points_first(const Stretch* s) {
  return lanes_select((floatW)(FIRST_POINT), (floatW)(END_INSET), s->dense);
}

// ∫ exp(-x u) du by its value at two points, of which the first is scaled to 1; they are `between` apart.
static inline floatW lanes_points_bend(floatW x, floatW between) {
  return 2.0f * lanes_mean_exp(x) / (1.0f + exp(-between * x));
}

// Of what is seen of a segment, the share about the second of its points.
static inline floatW points_share(const Stretch* s, floatW between, floatW depth) {
  const floatW behind = s->second * exp(-between * depth);
  return behind / ((1.0f - s->second) + behind);
}

// What of the light of both points is seen from the begin of the segments, in one channel of τ.
typedef struct {
  floatW first, second;
} Weights;

// `bends`: lanes whose τ to the light may be continued in a straight line from both points.
static inline Weights points_weigh(const Stretch* s, const Arrivals* a, int c, intW bends) {
  const floatW q = points_first(s), between = 1.0f - 2.0f * q, depth = s->depth[c];
  const floatW near = lanes_load(a[0].tau[c]), far = lanes_load(a[1].tau[c]), grows = (far - near) / between;
  const floatW limit = fmin(near, far) * (1.0f / FIRST_POINT);
  const floatW slope = fmin(fmax(grows, -limit), limit);
  const floatW span = lanes_select(depth, fabs(depth + slope), bends);
  const floatW lift = lanes_points_bend(span, between) / lanes_points_bend(depth, between);
  const floatW raise = q * (span - depth);
  const floatW share = points_share(s, between, depth);
  Weights w = {lift * exp(raise - near), lift * exp(raise - far)};
  if (lanes_any(s->dense & bends)) {
    const floatW begin = fmax(near - q * grows, (floatW)(0.0f)), end = fmax(far + q * grows, (floatW)(0.0f));
    const floatW mean = lanes_light_mean(begin, end, depth);
    w.first = lanes_select(w.first, mean, s->dense & bends);
    w.second = lanes_select(w.second, mean, s->dense & bends);
  }
  w.first *= 1.0f - share;
  w.second *= share;
  return w;
}

static inline floatW points_sum(const Arrivals* a, int color, const Weights* w) {
  return lanes_load(a[0].light[color]) * w->first + lanes_load(a[1].light[color]) * w->second;
}

static inline Colors sources_from_points(const Scene* scene, const Stretch* s, MediumResult* result) {
  float place[2][W];
  const floatW begin = lanes_load(s->at->begin), size = lanes_load(s->at->size), first = points_first(s);
  lanes_store(mad_exact(size, first, begin), place[0]);
  lanes_store(mad_exact(size, 1.0f - first, begin), place[1]);
  Colors sum = {(floatW)(0.0f), (floatW)(0.0f), (floatW)(0.0f)};
  for (int n = 0; n < scene->frame->light_picks; ++n) {
    Arrivals a[2];
    for (int e = 0; e < 2; ++e)
      arrivals_find(scene, s, n, place[e], e ? STREAM_LIGHT_END : STREAM_LIGHT, &a[e], result);
    intW bends = (intW)(0);
    if (TAKES_ENDS(scene)) bends = arrivals_lit(&a[0]) & arrivals_lit(&a[1]);
    Weights w[TAU_CHANNELS];
    for (int c = 0; c < TAU_CHANNELS; ++c) w[c] = points_weigh(s, a, c, bends);
    sum.x += points_sum(a, 0, &w[0]);
    sum.y += points_sum(a, 1, &w[TAU_CHANNELS / 2]);
    sum.z += points_sum(a, 2, &w[TAU_CHANNELS - 1]);
  }
  return sum;
}

// S of each segment.
static inline Colors stretch_sources(const Scene* scene, Stretch* s, MediumResult* result) {
  if (SUMS_BY(scene, s->medium, GAUSS2) && !PLACEMENT_IS(s->medium, COLLISIONS))
    return sources_from_points(scene, s, result);
#if BRUME_LIGHT_GRID
  if (s->medium->light_grids >= 0) return sources_from_grid(scene, s, result);
#endif
  return sources_traced(scene, s, result);
}

#endif
