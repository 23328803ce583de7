// Light of `adaptive`: what the points of a run along the view ray send of all lights (PICTURE, Runs).
#ifndef BRUME_MEDIA_RUNS_CL
#define BRUME_MEDIA_RUNS_CL
#include "media/run_light.cl"

#define RUN_UNASKED 0.125f  // of the tolerance: so much may all lights send that are asked nowhere

// Whether a light is asked nowhere, because it and all of those before it are too faint: half of it is taken then.
static inline int run_unasked(const Stretch* s, Run* run, RunLight* light, MediumResult* result) {
  float sends = 0.0f;
  for (int c = 0; c < TAU_CHANNELS; ++c) sends += light->upto[c][light->last];
  if (!(run->faint + sends <= s->medium->tolerance * RUN_UNASKED * run->seen)) return 0;
  run->faint += sends;
  result->error += (1.0f / 6.0f) * sends;
  for (int c = 0; c < TAU_CHANNELS; ++c)
    for (int i = light->first; i <= light->last; ++i) light->passed[c][i] = 0.5f;
  return 1;
}

// What the run sends to the origin; it is empty then.
OUTLINED float3 run_shine(const Scene* scene, const Stretch* s, Run* run, MediumResult* result) {
  float3 sum = (float3)(0.0f);
  RunLight light;
  for (int l = 0; l < scene->frame->light_count; ++l) {
    if (!run_weigh(scene, s, run, l, &light)) continue;
    if (!run_unasked(s, run, &light, result)) {
      run_pass(scene, s, run, l, &light, result);
#if HAS_SURFACES
      if (scene->lights[l].type != LIGHT_SURFACE) run_edges(scene, s, run, l, &light, result);
#endif
    }
    float3 its = (float3)(0.0f);
    for (int i = light.first; i <= light.last; ++i)
      its += (float3)(light.weight[0][i] * light.passed[0][i], light.weight[1][i] * light.passed[RUN_COLOR(1)][i],
                      light.weight[2][i] * light.passed[RUN_COLOR(2)][i]);
    sum += its;
    run->seen += its.x + its.y + its.z;
  }
  run->count = 0;
  return sum;
}

// The points of these segments, but of dense ones, each with its share of ∫ρT; a run that is full shines.
static inline void run_take(const Scene* scene, const Stretch* s, Run* run, LongSum* radiance, MediumResult* result) {
  const floatW begin = lanes_load(s->at->begin), size = lanes_load(s->at->size);
  float place[2][W], gain[TAU_CHANNELS][2][W], integral[W];
  lanes_store(lanes_select(lanes_load(s->integral), (floatW)(0.0f), s->dense), integral);
  lanes_store(mad_exact(size, (floatW)(FIRST_POINT), begin), place[0]);
  lanes_store(mad_exact(size, (floatW)(SECOND_POINT), begin), place[1]);
  for (int c = 0; c < TAU_CHANNELS; ++c) {
    const floatW share = points_share(s, (floatW)(BETWEEN_POINTS), s->depth[c]);
    lanes_store(s->gain[c] * (1.0f - share), gain[c][0]);
    lanes_store(s->gain[c] * share, gain[c][1]);
  }
  for (int i = 0; i < W; ++i) {
    if (!(integral[i] > 0.0f)) continue;
    for (int e = 0; e < 2; ++e, ++run->count) {
      run->place[run->count] = place[e][i];
      for (int c = 0; c < TAU_CHANNELS; ++c) run->gain[c][run->count] = gain[c][e][i];
#if BRUME_RANDOM
      run->id[run->count] = s->id[i];
#endif
    }
    if (run->count == RUN_POINTS) long_sum_add(radiance, run_shine(scene, s, run, result));
  }
}

#endif
