// What the batch of a strand sends to the origin of the ray, once the depth of the others is known at its marks.
#ifndef BRUME_MEDIA_STRAND_LIGHT_CL
#define BRUME_MEDIA_STRAND_LIGHT_CL
#include "media/strand.cl"

#if BRUME_MEDIA >= 3

// Depth of the others before and along each segment of the batch. Those that end behind the last mark are left out.
static inline void strand_others(const Scene* scene, const Strands* all, Strand* k, Stretch* s, uint* lookups) {
  float before[W], along[W];
  for (int i = 0; k->asks && i < W; ++i)
    if (k->ends_at[i] == 0 || k->ends_at[i] >= k->marks) s->integral[i] = 0.0f;
  for (int c = 0; c < TAU_CHANNELS; ++c) s->others[c] = s->beside[c] = (floatW)(0.0f);
  if (BRUME_MEDIA == 4 && all->apart) stretch_others(scene, s, all->first, all->end, &k->apart, lookups);
  for (int c = 0; k->asks && c < TAU_CHANNELS; ++c) {
    for (int i = 0; i < W; ++i) {
      const int end = max(k->ends_at[i], 1), lit = s->integral[i] > 0.0f;
      before[i] = lit ? k->tau_at[c][end - 1] : 0.0f;
      along[i] = lit ? fmax(k->tau_at[c][end] - k->tau_at[c][end - 1], 0.0f) : 0.0f;
    }
    s->others[c] += lanes_load(before);
    s->beside[c] += lanes_load(along);
  }
}

static inline int stretch_is_lit(const Stretch* s) { return lanes_any(lanes_load(s->integral) > (floatW)(0.0f)); }

// The depth of the others up to the first segment that counts.
static inline Others others_first(const Stretch* s) {
  Others others;
  int first = 0;
  while (first < W - 1 && !(s->integral[first] > 0.0f)) ++first;
  float tau[TAU_CHANNELS][W];
  for (int c = 0; c < TAU_CHANNELS; ++c) lanes_store(s->others[c], tau[c]);
  others.s = s->at->begin[first];
#if BRUME_COLOR_TAU
  others.tau = (float3)(tau[0][first], tau[1][first], tau[2][first]);
#else
  others.tau = tau[0][first];
#endif
  return others;
}

static inline void stretch_parts_walk(const Scene* scene, Stretch* s, const Segments* parts, uint* lookups) {
#if BRUME_RANDOM
  for (int i = 0; i < W; ++i) s->id[i] = parts->id[i];
#endif
  if (!RULE_IS(s->medium, GAUSS2) && !RULE_IS(s->medium, PIECE)) return;
  lanes_store(SUMS_BY(scene, s->medium, GAUSS2) ? walk_integral_shares(scene, s->medium, s->ray, parts, &s->second)
                                                : walk_integral(scene, s->medium, s->ray, parts),
              s->integral);
  *lookups += walk_lookups(s->medium, parts);
}

// Adds ∫ρ in the pieces of a growth up to and over W segments, which lie between `from` and `until`.
static inline void growth_beside(const Growth* g, int pieces, float from, float until, floatW begin, floatW end,
                                 Beside* out) {
  __attribute__((opencl_unroll_hint(1))) for (int n = 0; n < pieces && g->begin[n] < until; ++n) {
    const floatW first = growth_at(g, n, begin);
    out->before += first;
    if (g->end[n] > from) out->along += growth_at(g, n, end) - first;
  }
}

// The depth of the others up to and over parts of the batch, from the growths that are kept; 0 where one does not reach
// back so far.
static inline int strand_parts_others(const Strands* all, const Strand* k, Stretch* s) {
  const floatW begin = lanes_load(s->at->begin), end = begin + lanes_load(s->at->size);
  const intW counts = lanes_load(s->integral) > (floatW)(0.0f);
  const int n = s->at->count - 1;
  if (BRUME_MEDIA == 4 && all->apart) return 0;
  for (int c = 0; c < TAU_CHANNELS; ++c) s->others[c] = s->beside[c] = (floatW)(0.0f);
  for (int i = 0; i < all->count; ++i) {
    const Strand* o = all->strand + i;
    const float shift = s->ray->t_begin - o->ray.t_begin, from = s->at->begin[0] + shift;
    const float until = s->at->begin[n] + s->at->size[n] + shift;
    if (o == k || !(tau_max(o->sigma_t) > 0.0f)) continue;
    if (o->last_pieces > 0 && o->last_before > 0.0f && o->last.begin[0] > from) return 0;
    Beside beside = {(floatW)(o->last_before), (floatW)(0.0f)};
    growth_beside(&o->last, o->last_pieces, from, until, begin + shift, end + shift, &beside);
    growth_beside(&o->growth, o->pieces, from, until, begin + shift, end + shift, &beside);
    for (int c = 0; c < TAU_CHANNELS; ++c) {
      s->others[c] += tau_channel(o->sigma_t, c) * beside.before;
      s->beside[c] += tau_channel(o->sigma_t, c) * lanes_select((floatW)(0.0f), beside.along, counts);
    }
  }
  return 1;
}

// What the batch sends to the origin, or the parts of it where it is dense. What light asks for again and again is
// copied: in an array of strands the compiler cannot keep it in registers.
OUTLINED void strand_scatter(const Scene* scene, Strands* all, Strand* k, LongSum* radiance, MediumResult* result) {
  const Medium medium = k->medium;
  const MediumRay ray = k->ray;
  Stretch s = k->stretch;
  Segments parts;
  Cut cut;
  s.medium = &medium;
  s.ray = &ray;
  s.at = &k->at;
  if (HAS_LIGHT_KINKS(scene, &medium)) s.kinks = &k->lit_steps.kinks;
  s.ladder = all->ladder.step > 0.0f ? &all->ladder : 0;
  strand_others(scene, all, k, &s, &result->lookups);
  if (!stretch_is_lit(&s)) return;
  stretch_depths(&s, k->sigma_t);
  Others others = others_first(&s);
  const int cuts = !SUMS_BY(scene, &medium, RECTANGLE) && stretch_cut(scene, &s, &cut);
  int kept = 1;
  do {
    if (cuts) {
      stretch_parts(&k->at, &cut, &parts, &s);
      s.at = &parts;
      if (parts.count == 0) break;
      stretch_parts_walk(scene, &s, &parts, &result->lookups);
      kept = kept && strand_parts_others(all, k, &s);
      if (kept)
        others = others_first(&s);
      else
        stretch_others(scene, &s, k->number, k->number + 1, &others, &result->lookups);
      stretch_depths(&s, k->sigma_t);
    }
    stretch_gains(scene, &s, k->sigma_t, &k->tau);
    if (s.ladder) lanes_store(ladder_holds(s.ladder, &s), s.on_ladder);
    const float3 sent = stretch_radiance(scene, &s, 1, result);
    if (METHOD_IS(&medium, ADAPTIVE)) {
      stretch_rough(scene, &s, &k->rough);
      k->sent += vec_mean(sent);
    }
    long_sum_add(radiance, sent);
  } while (cuts && tau_min(k->tau + others.tau) < TAU_STOP);
  k->stretch.light_t = s.light_t;
  k->stretch.light_tau = s.light_tau;
}

#endif
#endif
