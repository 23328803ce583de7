// One of several media that are walked side by side along a view ray: the batch of segments in which it stands, how ∫ρ
// grows along it, and the marks, the places at which its segments begin and end.
#ifndef BRUME_MEDIA_STRAND_CL
#define BRUME_MEDIA_STRAND_CL
#include "media/radiative.cl"

#if BRUME_MEDIA >= 3

#define MARKS (2 * W)     // of a batch
#define WINDOW 32         // marks of a window at most, a multiple of W
#define WINDOW_WANTED 14  // and as a rule

// One medium of them: the batch of segments in which it stands.
typedef struct {
  Medium medium;
  MediumRay ray;
  Tau sigma_t;
  int number;  // of the medium
  int stored;  // its depth comes in batches; else it is constant, one piece from face to face
  int lit;     // its segments are asked for light
  int asks;    // others bring depth
  int ended;   // there are no more batches
  Walk walk;
  LitSteps lit_steps;  // of cells the kinks alone
  Segments at;
  Stretch stretch;
  Rough rough;  // of `adaptive`, and what it has sent to the origin
  float sent;
  int waits;            // the batch has not been asked for light
  float known;          // world distance up to which the batch reaches
  Tau tau;              // of the medium itself up to the batch
  Others apart;         // of media that are not walked together
  Growth growth, last;  // of this batch and the one before
  int pieces, last_pieces;
  int piece;                                // the first that reaches behind the last window
  float before, batch_before, last_before;  // ∫ρ up to it, up to the batch and up to the one before
  float mark[MARKS];                        // s, ascending
  float tau_at[TAU_CHANNELS][MARKS];        // of the others
  int next, marks;                          // the first mark that is not worked out
  uint ends;                                // bit: a segment ends there; it begins at the mark before
  int ends_at[W];                           // mark of each segment; 0 for one without light
} Strand;

// Marks of several media between the last window and this one's end.
typedef struct {
  float end, length;                 // world distance
  float s[WINDOW], t_begin[WINDOW];  // measured from where the medium of the mark begins
  int strand[WINDOW], mark[WINDOW];
  int count;
} Window;

// Media side by side: those from `first` to before `end` that the ray meets.
typedef struct {
  Strand strand[MEDIA_TOGETHER];
  int count;
  int first, end;
  int apart;   // there are others
  int closed;  // what is behind the window is black
  Ladder ladder;
  Window window;
} Strands;

// The share of ∫ρ about the second of two points, as walk_integral_shares has it.
static inline floatW growth_second(const Growth* g) {
  if (!GROWS_AS_CUBIC) return (floatW)(0.5f);
  const floatW c1 = lanes_load(g->c[1]), c2 = lanes_load(g->c[2]), c3 = lanes_load(g->c[3]);
  floatW density[2];
  for (int i = 0; i < 2; ++i) {
    const floatW u = (floatW)(i ? SECOND_POINT : FIRST_POINT);
    const floatW v = mad_exact(u, 4.0f * c3, 3.0f * c2);
    density[i] = fmax(mad_exact(u, mad_exact(u, v, 2.0f * c1), lanes_load(g->c[0])), (floatW)(0.0f));
  }
  const floatW sum = density[0] + density[1];
  return lanes_select((floatW)(0.5f), density[1] / sum, sum > 0.0f);
}

#define HAS_LIT_STEPS(scene, medium) (IN_SCATTERING_IS(scene, GAUSS2) && RULE_IS(medium, PRODUCT))

// 0: the ray misses the medium, or nothing comes of it.
OUTLINED int strand_begin(const Scene* scene, Strand* k, int m, float3 origin, float3 dir, float t_max, Random random) {
  k->medium = scene->media[m];
  k->ray = medium_ray(&k->medium, origin, dir, t_max);
  k->sigma_t = medium_sigma_t(&k->medium);
  k->lit = vec_max(vec_unpack(k->medium.sigma_s)) > 0.0f || vec_max(vec_unpack(k->medium.emission)) > 0.0f;
  if (!(k->ray.length > 0.0f) || !(k->lit || tau_max(k->sigma_t) > 0.0f)) return 0;
  k->number = m;
  k->stored = !RULE_IS(&k->medium, PRODUCT);
  k->ended = !k->stored && !k->lit;
  k->stretch = stretch_of(&k->medium, &k->ray, origin, dir, t_max, random, m);
  k->walk = walk_begin(scene, &k->medium, &k->ray, k->stretch.walk, WALK_SCATTERS);
  if (k->lit && HAS_LIT_STEPS(scene, &k->medium)) k->lit_steps = lit_steps_begin(scene, &k->stretch, m);
  if (HAS_LIGHT_KINKS(scene, &k->medium)) {
    kinks_begin(&k->lit_steps.kinks, 0.0f, k->ray.length);
    kinks_of_lights(scene, &k->stretch, &k->lit_steps.kinks);
  }
  k->rough.squares = k->rough.seen = k->rough.gain = k->sent = 0.0f;
  k->waits = 0;
  k->known = -INFINITY;
  k->tau = (Tau)(0.0f);
  k->apart.s = -k->ray.t_begin;
  k->apart.tau = (Tau)(0.0f);
  k->before = k->batch_before = k->last_before = 0.0f;
  k->next = k->marks = k->piece = k->pieces = k->last_pieces = 0;
  if (k->stored) return 1;
  for (int c = 0; c < 4; ++c) k->growth.c[c][0] = 0.0f;
  k->growth.begin[0] = 0.0f;
  k->growth.end[0] = k->ray.length;
  k->growth.inv_size[0] = 1.0f / k->ray.length;
  k->growth.c[0][0] = k->medium.constant_density * k->ray.length;
  k->pieces = 1;
  return 1;
}

// Where the segments of the batch begin and end: one mark for two that meet.
static inline void strand_mark(Strand* k) {
  float end = -1.0f;
  int n = 0;
  k->ends = 0;
  for (int i = 0; i < W; ++i) {
    k->ends_at[i] = 0;
    if (!(k->stretch.integral[i] > 0.0f)) continue;
    if (n == 0 || k->at.begin[i] > end * (1.0f + 0x1p-20f)) k->mark[n++] = k->at.begin[i];
    end = k->at.begin[i] + k->at.size[i];
    k->ends |= 1u << n;
    k->ends_at[i] = n;
    k->mark[n++] = end;
  }
  k->marks = n;
}

static inline void strand_grow(const Scene* scene, Strand* k) {
  Stretch* s = &k->stretch;
  if (k->pieces > 0) {
    k->last = k->growth;
    k->last_pieces = k->pieces;
    k->last_before = k->batch_before;
    k->batch_before = k->before;
  }
  k->growth = growth_of(scene, &k->medium, &k->ray, &k->at);
  lanes_store(growth_integral(&k->growth), s->integral);
  if (RULE_IS(&k->medium, PIECE))
    walk_integral_shares(scene, &k->medium, &k->ray, &k->at, &s->second);
  else if (IN_SCATTERING_IS(scene, GAUSS2))
    s->second = growth_second(&k->growth);
  k->piece = 0;
  for (int i = 0; i < W; ++i)
    if (k->at.size[i] > 0.0f) k->pieces = i + 1;
  k->known = k->ray.t_begin + k->growth.end[k->pieces - 1];
}

// The next batch.
OUTLINED void strand_fill(const Scene* scene, Strand* k, uint* lookups) {
  k->known = INFINITY;
  k->next = k->marks = 0;
  if (k->ended) return;
  if (HAS_LIT_STEPS(scene, &k->medium))
    lit_steps_fill(scene, &k->stretch, &k->lit_steps, &k->at);
  else
    walk_next(scene, &k->medium, &k->ray, &k->walk, &k->at);
  k->ended = k->at.count == 0;
  if (k->ended) return;
  k->waits = k->lit;
  k->stretch.second = (floatW)(0.5f);
  if (k->stored) {
    strand_grow(scene, k);
    *lookups += (uint)k->at.count;
  } else {
    lanes_store(walk_integral(scene, &k->medium, &k->ray, &k->at), k->stretch.integral);
  }
#if BRUME_RANDOM
  for (int i = 0; i < W; ++i) k->stretch.id[i] = walk_id(&k->medium, &k->at, i);
#endif
  if (k->lit && k->asks) strand_mark(k);
  if (!k->stored) k->known = k->marks > 0 ? k->ray.t_begin + k->mark[k->marks - 1] : -INFINITY;
}

#endif
#endif
