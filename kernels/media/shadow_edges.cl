// Where the light of a surface's shadow or of a spot's cone begins or ends within segments of the rule `gauss2`, or its
// way through a medium changes faces, it is taken over the parts between (PICTURE, Edges of shadows).
#ifndef BRUME_MEDIA_SHADOW_EDGES_CL
#define BRUME_MEDIA_SHADOW_EDGES_CL
#include "media/arrivals.cl"
#include "media/kinks.cl"

#define HAS_EDGES (HAS_SURFACES || USES_LIGHT(SPOT))
#define RAY_ASKED 64.0f       // places along the ray's way through the medium, at least, that say whether it is lit
#define EDGE_HALVINGS 12      // between two of them
#define EDGE_KEY 0x3C6EF372u  // of each, into the key
#define SEGMENT_EDGES 6       // that count
#define SEGMENT_KINKS 8
#define KINK_INSET 0x1p-10f
#define CUTS (SEGMENT_EDGES + SEGMENT_KINKS)
#define LIT_PARTS (SEGMENT_EDGES / 2 + 1 + SEGMENT_KINKS)

// Parts of W segments, as shares of them; those that are none have no length.
typedef struct {
  float begin[LIT_PARTS][W], end[LIT_PARTS][W];
} LitParts;

// Shares at which one segment is cut, ascending. At an edge light begins or ends.
typedef struct {
  float share[CUTS];
  int edge[CUTS];
  int count;
} Cuts;

static inline void cuts_add(Cuts* cuts, float share, int edge) {
  int i = cuts->count++;
  for (; i > 0 && cuts->share[i - 1] > share; --i) {
    cuts->share[i] = cuts->share[i - 1];
    cuts->edge[i] = cuts->edge[i - 1];
  }
  cuts->share[i] = share;
  cuts->edge[i] = edge;
}

#if HAS_EDGES
// Whether a light shines on a share of segment i. What is asked for that is no part of the key.
static inline int share_is_lit(const Scene* scene, const Stretch* s, int l, int i, float share, MediumResult* result) {
  const uint key = result->shadow_key;
  const float place = mad_exact(share, s->at->size[i], s->at->begin[i]);
  const int lit = vec_max(place_arriving(scene, s, l, place, result)) > 0.0f;
  result->shadow_key = key;
  return lit;
}

// Where between two shares of segment i, of which the first is lit as told and the second not so, that changes.
static inline float edge_find(const Scene* scene, const Stretch* s, int l, int i, float near, float far, int lit,
                              MediumResult* result) {
  for (int halving = 0; halving < EDGE_HALVINGS; ++halving) {
    const float middle = 0.5f * (near + far);
    if (share_is_lit(scene, s, l, i, middle, result) == lit)
      near = middle;
    else
      far = middle;
  }
  return 0.5f * (near + far);
}

// What was asked last: an end. The next segment mostly begins there.
typedef struct {
  float s;
  int lit;
} AskedEnd;

// Adds the edges of segment i, whose two points are lit as told; whether its begin is lit.
static inline int edges_find(const Scene* scene, const Stretch* s, int l, int i, int first, int second, AskedEnd* end,
                             Cuts* cuts, MediumResult* result) {
  const float begin = s->at->begin[i], size = s->at->size[i];
  const float share[4] = {END_INSET, FIRST_POINT, SECOND_POINT, 1.0f - END_INSET};
  const int lit[4] = {-1, first, second, -1};
  const int begins =
      fabs(begin - end->s) <= 0x1p-10f * size ? end->lit : share_is_lit(scene, s, l, i, share[0], result);
  float before = share[0];
  int was = begins;
  for (int k = 1; k < 4; ++k) {
    const float gap = share[k] - share[k - 1];
    const float asked = ceil(gap * size * RAY_ASKED / s->ray->length - PARTS_SLACK);
    for (float n = 1.0f; cuts->count < SEGMENT_EDGES && n <= fmax(asked, 1.0f); ++n) {
      const int is_last = n >= asked;
      const float at = is_last ? share[k] : mad_exact(gap, n / asked, share[k - 1]);
      const int is = is_last && lit[k] >= 0 ? lit[k] : share_is_lit(scene, s, l, i, at, result);
      if (is != was) cuts_add(cuts, edge_find(scene, s, l, i, before, at, was, result), 1);
      before = at;
      was = is;
    }
  }
  end->s = cuts->count < SEGMENT_EDGES ? begin + size : -INFINITY;
  end->lit = was;
  return begins;
}
#endif

static inline void kinks_find(const Kinks* kinks, const Segments* at, int i, Cuts* cuts) {
  int n = 0;
  for (int k = 0; k < kinks->count && n < SEGMENT_KINKS; ++k) {
    const float share = (kinks->s[k] - at->begin[i]) / at->size[i];
    if (!(share > KINK_INSET && share < 1.0f - KINK_INSET)) continue;
    cuts_add(cuts, share, 0);
    ++n;
  }
}

// The parts of segment i between its cuts that are lit; number of them.
static inline int cuts_part(const Cuts* cuts, int lit, int i, LitParts* parts) {
  int n = 0;
  float begin = 0.0f;
  for (int k = 0; k <= cuts->count; ++k) {
    const float end = k < cuts->count ? cuts->share[k] : 1.0f;
    if (lit) {
      parts->begin[n][i] = begin;
      parts->end[n++][i] = end;
    }
    if (k < cuts->count && cuts->edge[k]) lit = !lit;
    begin = end;
  }
  return n;
}

// Kinks of one light within the batch.
static inline void stretch_kinks(const Stretch* s, int l, Kinks* kinks) {
  const int last = s->at->count - 1;
  kinks_begin(kinks, s->at->begin[0], s->at->begin[last] + s->at->size[last]);
  for (int i = 0; s->kinks && i < s->kinks->count; ++i)
    if (s->kinks->light[i] == l) kink_add(kinks, s->kinks->s[i]);
}

// The lit parts of all segments that are cut; their light is taken out of `a`. Largest number of parts.
static inline int lit_parts_take(const Scene* scene, const Stretch* s, int l, Arrivals* a, LitParts* parts,
                                 MediumResult* result) {
  if (!LIGHTS_ALL(scene) || LIGHT_IS(&scene->lights[l], SURFACE)) return 0;
  Kinks kinks;
  stretch_kinks(s, l, &kinks);
  if (!HAS_EDGES && kinks.count == 0) return 0;
  int lit[2][W], deep[W], most = 0;
#if HAS_EDGES
  AskedEnd end = {-INFINITY, 0};
#endif
  for (int e = 0; e < 2; ++e) lanes_store(arrivals_lit(&a[e]), lit[e]);
  lanes_store(stretch_deep(s), deep);
  for (int i = 0; i < W; ++i) {
    for (int n = 0; n < LIT_PARTS; ++n) parts->begin[n][i] = parts->end[n][i] = 0.0f;
    if (!(s->integral[i] > 0.0f) || deep[i]) continue;
    Cuts cuts;
    cuts.count = 0;
    int begins_lit = lit[0][i] != 0;
#if HAS_EDGES
    begins_lit = edges_find(scene, s, l, i, lit[0][i] != 0, lit[1][i] != 0, &end, &cuts, result);
    result->shadow_key += (uint)cuts.count * EDGE_KEY * (uint)(l + 1);
#endif
    kinks_find(&kinks, s->at, i, &cuts);
    if (cuts.count == 0) continue;
    most = max(most, cuts_part(&cuts, begins_lit, i, parts));
    for (int e = 0; e < 2; ++e)
      for (int c = 0; c < 3; ++c) a[e].light[c][i] = 0.0f;
  }
  return most;
}

// The two points of one part of each segment, as shares of the segment.
static inline void lit_part(const LitParts* parts, int n, floatW* share, floatW* length) {
  const floatW begin = lanes_load(parts->begin[n]);
  *length = lanes_load(parts->end[n]) - begin;
  share[0] = mad_exact(*length, (floatW)(FIRST_POINT), begin);
  share[1] = mad_exact(*length, (floatW)(SECOND_POINT), begin);
}

// ρT at a share of each segment by the whole of it, ρ a straight line through both points.
static inline floatW share_weight(const Stretch* s, int c, floatW share) {
  const floatW slope = (2.0f * s->second - 1.0f) / BETWEEN_POINTS, depth = s->depth[c];
  const floatW all = (1.0f - s->second) * exp(-FIRST_POINT * depth) + s->second * exp(-SECOND_POINT * depth);
  return fmax(mad_exact(slope, 2.0f * share - 1.0f, (floatW)(1.0f)), (floatW)(0.0f)) * exp(-share * depth) / all;
}

// What of the light of both points of a lit part is seen, in one channel of τ. Lanes without a part may be too deep for
// any of that.
static inline Weights part_weigh(const Stretch* s, const Arrivals* a, int c, const floatW* share, floatW length) {
  const intW is_none = !(length > 0.0f);
  floatW weight[2];
  for (int e = 0; e < 2; ++e)
    weight[e] = lanes_select(0.5f * length * share_weight(s, c, share[e]) * exp(-lanes_load(a[e].tau[c])),
                             (floatW)(0.0f), is_none);
  const Weights w = {weight[0], weight[1]};
  return w;
}

#endif
