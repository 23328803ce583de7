// Several media along a view ray, walked side by side: each once, and what a segment of one meets of the others is read
// off the batches in which they stand. The ray is worked through in windows of some marks. Few segments of each medium
// reach into one, so that n media cost about n.
#ifndef BRUME_MEDIA_TOGETHER_CL
#define BRUME_MEDIA_TOGETHER_CL
#include "media/strand_light.cl"

#if BRUME_MEDIA >= 3

// The marks up to the end of the window; 0 if there are too many.
static inline int window_take(Strands* all) {
  Window* w = &all->window;
  const float end = w->end;
  const int count = all->count;
  int taken = 0;
  for (int i = 0; i < count; ++i) {
    const Strand* k = all->strand + i;
    const float t_begin = k->ray.t_begin;
    const int marks = k->marks;
    for (int n = k->next; n < marks && t_begin + k->mark[n] <= end; ++n) {
      if (taken == WINDOW) return 0;
      w->s[taken] = k->mark[n];
      w->t_begin[taken] = t_begin;
      w->strand[taken] = i;
      w->mark[taken++] = n;
    }
    w->count = taken;
  }
  return 1;
}

// The next marks before the world distance `known`. Where too many fall on one place, the rest waits for the next
// window.
static inline void window_next(Strands* all, float known) {
  Window* w = &all->window;
  const float begin = w->end;
  for (;;) {
    w->end = fmin_ordered(known, begin + w->length);
    if (window_take(all) || !(w->end > begin)) break;
    w->length = 0.5f * (w->end - begin);
  }
  w->length *= clamp((float)WINDOW_WANTED / (float)max(w->count, 1), 0.5f, 1.5f);
  for (int p = w->count; p < WINDOW; ++p) {
    w->s[p] = w->t_begin[p] = 0.0f;
    w->strand[p] = -1;
  }
}

// ∫ρ of a medium up to W places. *piece and *before move past the pieces that end before the window does.
static inline floatW strand_depth(const Strand* k, floatW at, float end, int* piece, float* before) {
  const Growth* growth = &k->growth;
  const float t_begin = k->ray.t_begin;
  floatW depth = (floatW)(*before);
  int n = *piece;
  for (; n < k->pieces && t_begin + growth->begin[n] <= end; ++n) {
    depth += growth_at(growth, n, at);
    if (t_begin + growth->end[n] > end) break;
    *before += growth_whole(growth, n);
  }
  *piece = n;
  return depth;
}

// τ of the other media at W marks, those of the window from `first` on. The last ones take the media along.
OUTLINED void window_depths(Strands* all, int first) {
  const Window* w = &all->window;
  const floatW s = lanes_load(w->s + first), t_begin = lanes_load(w->t_begin + first);
  const intW strand = lanes_load(w->strand + first);
  const int count = all->count;
  floatW tau[TAU_CHANNELS];
  float tau_at[TAU_CHANNELS][W];
  for (int c = 0; c < TAU_CHANNELS; ++c) tau[c] = (floatW)(0.0f);
  for (int i = 0; i < count; ++i) {
    Strand* k = all->strand + i;
    int piece = k->piece;
    float before = k->before;
    const floatW at = s + (t_begin - k->ray.t_begin);  // the shift is 0 for media on one spot, however far the eye
    floatW depth = strand_depth(k, at, w->end, &piece, &before);
    if (first + W >= w->count) {
      k->piece = piece;
      k->before = before;
    }
    depth = lanes_select(depth, (floatW)(0.0f), strand == (intW)(i));
    for (int c = 0; c < TAU_CHANNELS; ++c) tau[c] = mad_exact((floatW)(tau_channel(k->sigma_t, c)), depth, tau[c]);
  }
  for (int c = 0; c < TAU_CHANNELS; ++c) lanes_store(tau[c], tau_at[c]);
  for (int p = first; p < min(first + W, w->count); ++p) {
    Strand* k = all->strand + w->strand[p];
    for (int c = 0; c < TAU_CHANNELS; ++c) k->tau_at[c][w->mark[p]] = tau_at[c][p - first];
    k->next = w->mark[p] + 1;
  }
}

// τ of all media up to t, of what is stored no more than is passed.
static inline Tau strands_tau(const Strands* all, float t) {
  Tau tau = (Tau)(0.0f);
  for (int i = 0; i < all->count; ++i) {
    const Strand* k = all->strand + i;
    tau += k->sigma_t *
           (k->stored ? k->before : k->medium.constant_density * clamp(t - k->ray.t_begin, 0.0f, k->ray.length));
  }
  return tau;
}

// What is behind is black: only the segments in which the media stand are still asked for.
static inline void strands_close(Strands* all) {
  all->closed = 1;
  for (int i = 0; i < all->count; ++i) {
    Strand* k = all->strand + i;
    if (k->next < k->marks) k->marks = k->next + (int)((k->ends >> k->next) & 1u);
    k->lit = 0;
    k->ended |= !k->stored;
  }
}

// Asks for the light of batches that are behind, and fills the next ones. Returns the world distance up to which all
// media are known, INFINITY at the end.
static inline float strands_next(const Scene* scene, Strands* all, LongSum* radiance, MediumResult* result) {
  float known = INFINITY;
  int awaited = !all->closed;
  for (int i = 0; i < all->count; ++i) {
    Strand* k = all->strand + i;
    while (k->next == k->marks && (k->known <= all->window.end || (k->waits && all->closed))) {
      if (k->waits) strand_scatter(scene, all, k, radiance, result);
      k->waits = 0;
      if (!(k->known <= all->window.end)) break;
      strand_fill(scene, k, &result->lookups);
    }
    awaited |= k->next < k->marks;
    known = fmin_ordered(known, k->known);
  }
  return awaited ? known : INFINITY;
}

// A ladder that begins where the first of the media that take light from it does.
static inline void ladder_begin(const Scene* scene, Strands* all) {
  Ladder* ladder = &all->ladder;
  float cells = 0.0f;
  ladder->media = 0;
  ladder->begin = INFINITY;
  for (int i = 0; scene->frame->light_ladder && i < all->count; ++i) {
    const Strand* k = all->strand + i;
    if (!ladder_takes(&k->medium)) continue;
    ladder->from[ladder->media] = k->ray.t_begin;
    ladder->until[ladder->media++] = k->ray.length;
    ladder->begin = fmin(ladder->begin, k->ray.t_begin);
    cells = fmax(cells, length(k->ray.dir));
  }
  for (int i = 0; i < ladder->media; ++i) {
    ladder->from[i] -= ladder->begin;
    ladder->until[i] += ladder->from[i];
  }
  ladder->step = ladder->media >= LADDER_MEDIA ? LADDER_CELLS / cells : 0.0f;
  for (int l = 0; ladder->step > 0.0f && l < LADDER_LIGHTS; ++l)
    for (int i = 0; i < LADDER_RUNGS; ++i) ladder->number[l][i] = INT_MIN;
}

// The media from *m on, as many as are walked together; *m becomes the next one.
static inline void strands_begin(const Scene* scene, Strands* all, int* m, float3 origin, float3 dir, float t_max,
                                 Random random) {
  int weaken = 0;
  all->count = all->closed = 0;
  all->first = *m;
  all->window.end = all->window.length = INFINITY;
  for (; *m < MEDIA_END(scene) && all->count < MEDIA_TOGETHER; ++*m)
    all->count += strand_begin(scene, all->strand + all->count, *m, origin, dir, t_max, random);
  all->end = *m;
  all->apart = all->first > 0 || all->end < MEDIA_END(scene);
  for (int i = 0; i < all->count; ++i) {
    weaken += tau_max(all->strand[i].sigma_t) > 0.0f;
    all->window.end = fmin(all->window.end, all->strand[i].ray.t_begin);
  }
  ladder_begin(scene, all);
  for (int i = 0; i < all->count; ++i) all->strand[i].asks = weaken > (tau_max(all->strand[i].sigma_t) > 0.0f);
}

// What `adaptive` may err by.
static inline void strands_tell(const Strands* all, MediumResult* result) {
  for (int i = 0; USES_METHOD(ADAPTIVE) && i < all->count; ++i) {
    const Strand* k = all->strand + i;
    if (METHOD_IS(&k->medium, ADAPTIVE)) rough_tell(&k->rough, k->sigma_t, k->sent, result);
  }
}

// Adds what they scatter to *radiance and returns their optical depth.
static inline Tau media_scatter_together(const Scene* scene, int* m, float3 origin, float3 dir, float t_max,
                                         Random random, LongSum* radiance, MediumResult* result) {
  Strands all;
  strands_begin(scene, &all, m, origin, dir, t_max, random);
  for (;;) {
    const float known = strands_next(scene, &all, radiance, result);
    if (known == INFINITY) {
      strands_tell(&all, result);
      return strands_tau(&all, INFINITY);
    }
    window_next(&all, known);
    for (int first = 0; first == 0 || first < all.window.count; first += W) window_depths(&all, first);
    if (!all.closed && tau_min(strands_tau(&all, all.window.end)) >= TAU_STOP) strands_close(&all);
  }
}

#endif
#endif
