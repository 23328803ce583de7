// The dispatcher over lights: which of them a point asks, and what one sends to it, as shared/light.h defines them.
#ifndef BRUME_LIGHTS_LIGHTS_CL
#define BRUME_LIGHTS_LIGHTS_CL
#include "lib/rng.cl"
#include "lights/directional.cl"
#include "lights/emitter.cl"
#include "lights/point.cl"
#include "lights/spot.cl"

// `random`, of the ray, says which place of a light with an extent is asked. A row without its function does not
// compile.
static inline LightSample light_sample(const Scene* scene, int index, float3 point, Random random) {
  const Light light = scene->lights[index];
  if (LIGHT_IS(&light, SURFACE)) return emitter_sample(scene, &light, point, random);
#define ROW(id, name, help) \
  if (LIGHT_IS(&light, id)) return name##_sample(&light, point);
  BRUME_LIGHTS(ROW)
#undef ROW
  return directional_sample(&light, point);
}

// One of the lights that a point asks, and what its light counts.
typedef struct {
  int light;
  float weight;
} LightPick;

#if BRUME_LIGHTS_CHOSEN
// The largest index whose share begins at or before x; light_shares rises from 0.
static inline int light_at_share(const Scene* scene, float x) {
  int low = 0, high = scene->frame->light_count;
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    if (scene->light_shares[middle] <= x)
      low = middle;
    else
      high = middle;
  }
  return low;
}
#endif

// Number n of frame->light_picks. All lights in their order; of too many, picks at even distances along the sum of
// their powers, moved by one random number xi for all of a point.
static inline LightPick light_choose(const Scene* scene, int n, float xi) {
  LightPick pick;
  pick.light = n;
  pick.weight = 1.0f;
#if BRUME_LIGHTS_CHOSEN
  if (scene->frame->light_picks == scene->frame->light_count) return pick;
  const float picks = (float)scene->frame->light_picks;
  pick.light = light_at_share(scene, ((float)n + xi) / picks);
  const float share = scene->light_shares[pick.light + 1] - scene->light_shares[pick.light];
  pick.weight = 1.0f / (picks * share);
#endif
  return pick;
}

// The random number with which segment n of a walk chooses, or a surface, n = 0.
static inline float light_choice(Random random, uint n) {
#if BRUME_LIGHTS_CHOSEN
  const Random own = random_stream(random, STREAM_LIGHT_CHOICE);
  return random_at(&own, n, RANDOM_PLACE);
#else
  (void)random;
  (void)n;
  return 0.0f;
#endif
}

// What comes from infinitely far away along -dir where nothing is hit.
static inline float3 background_radiance(const Scene* scene, float3 dir) {
  (void)dir;
  return vec_unpack(scene->frame->background);
}

#endif
