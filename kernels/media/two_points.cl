// The rule `gauss2`: light at two points of each segment (PICTURE, Two points); and which rule a segment takes.
#ifndef BRUME_MEDIA_TWO_POINTS_CL
#define BRUME_MEDIA_TWO_POINTS_CL
#include "media/shadow_edges.cl"

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

// Light n at the points of each segment, then at those of what is lit of the segments that are lit in part.
static inline void points_add(const Scene* scene, const Stretch* s, int n, Colors* sum, MediumResult* result) {
  const floatW begin = lanes_load(s->at->begin), size = lanes_load(s->at->size), first = points_first(s);
  floatW share[2] = {first, 1.0f - first}, length = lanes_load(s->integral);
  LitParts parts;
  for (int turn = 0, turns = 1; turn < turns; ++turn) {
    float counts[W];
    Arrivals a[2];
    if (turn > 0) lit_part(&parts, turn - 1, share, &length);
    lanes_store(length, counts);
    for (int e = 0; e < 2; ++e) {
      float place[W];
      lanes_store(mad_exact(size, share[e], begin), place);
      arrivals_find(scene, s, n, place, counts, e ? STREAM_LIGHT_END : STREAM_LIGHT, &a[e], result);
    }
    if (turn == 0) turns += lit_parts_take(scene, s, n, a, &parts, result);
    intW bends = (intW)(0);
    if (TAKES_ENDS(scene)) bends = arrivals_lit(&a[0]) & arrivals_lit(&a[1]);
    Weights w[TAU_CHANNELS];
    for (int c = 0; c < TAU_CHANNELS; ++c)
      w[c] = turn > 0 ? part_weigh(s, a, c, share, length) : points_weigh(s, a, c, bends);
    sum->x += points_sum(a, 0, &w[0]);
    sum->y += points_sum(a, 1, &w[TAU_CHANNELS / 2]);
    sum->z += points_sum(a, 2, &w[TAU_CHANNELS - 1]);
  }
}

static inline Colors sources_from_points(const Scene* scene, const Stretch* s, MediumResult* result) {
  Colors sum = {(floatW)(0.0f), (floatW)(0.0f), (floatW)(0.0f)};
  for (int n = 0; n < scene->frame->light_picks; ++n) points_add(scene, s, n, &sum, result);
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
