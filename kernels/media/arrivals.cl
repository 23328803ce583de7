// What shadow rays bring to two points of each segment of a stretch.
#ifndef BRUME_MEDIA_ARRIVALS_CL
#define BRUME_MEDIA_ARRIVALS_CL
#include "media/sources.cl"

#define FIRST_POINT 0.211324865405187f   // (1 - 1/√3) / 2 of the segment
#define SECOND_POINT 0.788675134594813f  // and as far from its end
#define BETWEEN_POINTS 0.577350269189626f

// What one shadow ray of each segment brings to one of its points: E · V · p and the depth on the way.
typedef struct {
  float light[3][W];  // 0 where nothing arrives; the depth is not asked for then
  float tau[TAU_CHANNELS][W];
} Arrivals;

// What of the light of both points is seen from the begin of the segments, in one channel of τ.
typedef struct {
  floatW first, second;
} Weights;

// Shadow ray n to the light from `place` in each segment that counts.
static inline void arrivals_find(const Scene* scene, const Stretch* s, int n, const float* place, const float* counts,
                                 uint stream, Arrivals* out, MediumResult* result) {
  for (int i = 0; i < W; ++i) {
    float3 arriving = (float3)(0.0f);
    Tau tau = (Tau)(0.0f);
    if (counts[i] > 0.0f) {
      const LightPick pick = light_choose(scene, n, light_choice(s->walk, stretch_id(s, i)));
      arriving = pick.weight * place_arriving(scene, s, pick.light, place[i], result);
      if (vec_max(arriving) > 0.0f && !(BRUME_LIGHT_GRID && s->medium->light_grids >= 0))
        tau = segment_light_depth(scene, s, pick.light, i, place[i], stretch_random(s, i, stream + (uint)n),
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

#endif
