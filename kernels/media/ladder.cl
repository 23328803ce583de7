// Depth to the lights from evenly spaced places of a view ray, the rungs of a ladder, between which it is interpolated
// where several media that scatter stand on one spot: each has its own places of light, and they lie so close together
// that asking all media from each of them would say little more (PICTURE, Media on one spot).
#ifndef BRUME_MEDIA_LADDER_CL
#define BRUME_MEDIA_LADDER_CL
#include "media/stretch.cl"

// Depth of all media from a point of the view ray, at world distance t, to light l.
static inline Tau light_depth(const Scene* scene, const Stretch* s, int l, float t, Random random, uint* lookups) {
  const float3 point = vec_point(s->origin, s->dir, t);
  const LightSample light = light_sample(scene, l, point, s->random);
  return media_tau(scene, -1, point, -light.travel, light.distance, random, lookups);
}

#if BRUME_MEDIA >= 3

#define LADDER_CELLS 0.5f    // from rung to rung, of the finest grid
#define LADDER_MEDIA 2       // that scatter, on one spot
#define LADDER_RUNGS 32      // kept of each light, a power of two
#define LADDER_DEPTH 0.25f   // of all media from rung to rung, at most
#define LADDER_BEND 0x1p-9f  // of 1 + its depth that a place may be off a straight line between two rungs
#define LADDER_LAMP 8.0f     // rungs to a lamp, at least

typedef struct Ladder {
  float begin, step;  // world distance of rung 0, and from each to the next; step 0: there is none
  int media;
  float from[MEDIA_TOGETHER], until[MEDIA_TOGETHER];  // of those that scatter, from rung 0
  int number[LADDER_LIGHTS][LADDER_RUNGS];            // of the rung that is kept there
  Tau tau[LADDER_LIGHTS][LADDER_RUNGS];
} Ladder;

static inline int ladder_takes(const Medium* medium) {
  return PLACEMENT_IS(medium, CELLS) && medium->light_grids < 0 && vec_max(vec_unpack(medium->sigma_s)) > 0.0f;
}

// Lanes whose segment takes depths to the light from the ladder.
static inline intW ladder_holds(const Ladder* ladder, const Stretch* s) {
  const floatW size = lanes_load(s->at->size);
  const floatW middle = mad_exact((floatW)(0.5f), size, lanes_load(s->at->begin)) + (s->ray->t_begin - ladder->begin);
  intW media = (intW)(0);
  for (int i = 0; i < ladder->media; ++i) {
    const intW holds = (middle >= (floatW)(ladder->from[i])) & (middle <= (floatW)(ladder->until[i]));
    media += lanes_select((intW)(0), (intW)(1), holds);
  }
  return (media >= (intW)(LADDER_MEDIA)) & (stretch_depth_max(s) * ladder->step <= LADDER_DEPTH * size);
}

static inline Tau ladder_rung(const Scene* scene, const Stretch* s, int l, int rung, uint* lookups) {
  Ladder* ladder = s->ladder;
  const int at = rung & (LADDER_RUNGS - 1);
  if (ladder->number[l][at] != rung) {
    ladder->tau[l][at] =
        light_depth(scene, s, l, mad_exact((float)rung, ladder->step, ladder->begin), s->walk, lookups);
    ladder->number[l][at] = rung;
  }
  return ladder->tau[l][at];
}

// Whether light l is far enough from a point of the view ray for the depth to it to change smoothly.
static inline int ladder_reaches(const Scene* scene, const Stretch* s, int l, float t) {
  const Light light = scene->lights[l];
  if (LIGHT_IS(&light, DIRECTIONAL)) return 1;
  const float reach = LADDER_LAMP * s->ladder->step;
  const float3 to = vec_unpack(light.position) - vec_point(s->origin, s->dir, t);
  return dot(to, to) > reach * reach;
}

// The cubic through the four rungs about a place of the stretch; 0: too far from a straight line.
static inline int ladder_depth(const Scene* scene, const Stretch* s, int l, float place, Tau* depth, uint* lookups) {
  const float along = (place + (s->ray->t_begin - s->ladder->begin)) / s->ladder->step, rung = floor(along);
  const float u = along - rung, v = 1.0f - u;
  Tau tau[4];
  for (int k = 0; k < 4; ++k) tau[k] = ladder_rung(scene, s, l, (int)rung + k - 1, lookups);
  const Tau line = v * tau[1] + u * tau[2];
  const Tau bend = (1.0f / 6.0f) * u * v * (3.0f * line - ((1.0f + v) * tau[0] + (1.0f + u) * tau[3]));
  *depth = fmax(line + bend, (Tau)(0.0f));
  return tau_max(fabs(bend) - LADDER_BEND * line) <= LADDER_BEND;
}

#define segment_is_on_ladder(s, i) ((s)->ladder && (s)->on_ladder[i])
#else
#define segment_is_on_ladder(s, i) 0
#endif

// Depth of all media from `place` on segment i to light l: off the ladder, or the segment asks for itself.
static inline Tau segment_light_depth(const Scene* scene, const Stretch* s, int l, int i, float place, Random random,
                                      uint* lookups) {
  const float t = s->ray->t_begin + place;
#if BRUME_MEDIA >= 3
  Tau tau;
  if (segment_is_on_ladder(s, i) && ladder_reaches(scene, s, l, t) && ladder_depth(scene, s, l, place, &tau, lookups))
    return tau;
#endif
  return light_depth(scene, s, l, t, random, lookups);
}

#endif
