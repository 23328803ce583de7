// Steps through a constant medium for the rule `gauss2`: they end where light has a kink along the ray, are finer near
// lights and leave out what no light reaches (PICTURE, Lit steps).
#ifndef BRUME_MEDIA_LIT_STEPS_CL
#define BRUME_MEDIA_LIT_STEPS_CL
#include "lights/lights.cl"
#include "media/kinks.cl"

#define KINK_APART 0x1p-16f            // of the ray inside the medium: kinks closer than that are one
#define GRADE_FINEST (1.0f / 1024.0f)  // of a step: no shorter for that

typedef struct {
  Kinks kinks;
  float s;    // where the next segment begins
  uint next;  // number of it
} LitSteps;

// How far a point of the ray is from a light. Behind a face of the box through which its light comes the depth to it
// bends as 1 / (distance along the ray to the plane of the light beside that face).
static inline float light_apart(const Stretch* stretch, const Light* light, float s) {
  const float3 position = vec_unpack(light->position);
  const float3 point = vec_point(stretch->origin, stretch->dir, stretch->ray->t_begin + s);
  float apart = length(point - position);
  if (stretch->medium->region != REGION_BOX) return apart;
  const float3 in_cells = affine_point(&stretch->medium->cell_from_world, position);
  const float3 lo = vec_unpack(stretch->medium->lo), hi = vec_unpack(stretch->medium->hi);
  const float3 ahead = (in_cells - vec_point(stretch->ray->origin, stretch->ray->dir, s)) / stretch->ray->dir;
  if (in_cells.x < lo.x || in_cells.x > hi.x) apart = fmin(apart, fabs(ahead.x));
  if (in_cells.y < lo.y || in_cells.y > hi.y) apart = fmin(apart, fabs(ahead.y));
  if (in_cells.z < lo.z || in_cells.z > hi.z) apart = fmin(apart, fabs(ahead.z));
  return apart;
}

static inline LitSteps lit_steps_begin(const Scene* scene, const Stretch* stretch, int m) {
  LitSteps k;
  k.s = 0.0f;
  k.next = 0;
  kinks_begin(&k.kinks, 0.0f, stretch->ray->length);
  if (!LIGHTS_ALL(scene)) return k;
  for (int other = 0; other < MEDIA_END(scene); ++other) {
    if (other == m) continue;
    const Medium medium = scene->media[other];
    const MediumRay ray = medium_ray(&medium, stretch->origin, stretch->dir, stretch->t_max);
    const float begin = ray.t_begin - stretch->ray->t_begin;
    if (ray.length > 0.0f) kink_add(&k.kinks, begin);
    if (ray.length > 0.0f) kink_add(&k.kinks, begin + ray.length);
  }
  kinks_of_lights(scene, stretch, &k.kinks);
  return k;
}

// How long the segment that begins at s may be, if nothing happens before `end`.
static inline float lit_step(const Scene* scene, const Stretch* stretch, const LitSteps* k, float end) {
  const float step = stretch->medium->step;
  if (!LIGHTS_ALL(scene)) return step;
  const float t = stretch->ray->t_begin + k->s;
  const float3 middle = vec_point(stretch->origin, stretch->dir, t + 0.5f * fmin(end - k->s, step));
  int lit = k->kinks.count == KINKS_MAX;  // a cone may have been left out
  float longest = step;
  for (int l = 0; l < scene->frame->light_count; ++l) {
    const Light light = scene->lights[l];
    if (LIGHT_IS(&light, SPOT) && light.exponent == 0 &&
        !(vec_max(light_sample(scene, l, middle, stretch->random).irradiance) > 0.0f))
      continue;
    lit = 1;
    if (LIGHT_IS(&light, DIRECTIONAL) || light.exponent != 0) continue;
    longest = fmin(longest, stretch->medium->light_grade * light_apart(stretch, &light, k->s));
  }
  return lit ? fmax(longest, GRADE_FINEST * step) : INFINITY;
}

static inline void lit_steps_fill(const Scene* scene, const Stretch* stretch, LitSteps* k, Segments* out) {
  const float length = stretch->ray->length, apart = KINK_APART * length;
  int n = 0;
  for (; n < W && k->s < length; ++n) {
    float end = length;
    for (int i = 0; i < k->kinks.count; ++i)
      if (k->kinks.s[i] > k->s + apart) end = fmin(end, k->kinks.s[i]);
    end = fmin(end, k->s + lit_step(scene, stretch, k, end));
    if (!(end < length - apart)) end = length;
    out->begin[n] = k->s;
    out->place[n] = 0.5f * (k->s + end);
    out->size[n] = end - k->s;
#if BRUME_RANDOM
    out->id[n] = k->next;
#endif
    ++k->next;
    k->s = end;
  }
  out->count = n;
  segments_pad(out);
}

#endif
