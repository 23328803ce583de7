// Steps through a constant medium for the rule `gauss2`: they end where light has a kink along the ray, are finer near
// lights and leave out what no light reaches (PICTURE, Lit steps).
#ifndef BRUME_MEDIA_LIT_STEPS_CL
#define BRUME_MEDIA_LIT_STEPS_CL
#include "lights/lights.cl"
#include "media/stretch.cl"

#define KINKS_MAX 64
#define CONES 8  // a spot's soft edge in equal parts of 1 - cos: what a grazing ray sees of it is no polynomial
#define KINK_APART 0x1p-16f            // of the ray inside the medium: kinks closer than that are one
#define LIGHT_GRADE 0.1f               // of the distance to a light: no step near it is longer
#define GRADE_FINEST (1.0f / 1024.0f)  // of a step: no shorter for that

typedef struct {
  float kink[KINKS_MAX];  // s, in no order
  int count;
  float s;    // where the next segment begins
  uint next;  // number of it
} LitSteps;

static inline void kink_add(LitSteps* k, float s, float length) {
  if (s > 0.0f && s < length && k->count < KINKS_MAX) k->kink[k->count++] = s;
}

// Where a ray in the light's own space, `from` the light, crosses the cone of 1 - cos = beside.
static inline void cone_kinks(LitSteps* k, float3 from, float3 dir, float3 axis, float beside, float length) {
  const float cosine = 1.0f - beside, square = cosine * cosine;
  const float along = dot(dir, axis), height = dot(from, axis);
  const float a = along * along - square, b = height * along - square * dot(from, dir);
  const float c = height * height - square * dot(from, from), root = b * b - a * c;
  if (!(root >= 0.0f)) return;
  for (int side = -1; side <= 1; side += 2) {
    const float s = ((float)side * sqrt(root) - b) / a;
    if (mad_exact(s, along, height) * cosine >= 0.0f) kink_add(k, s, length);
  }
}

// Where the way from the ray to a light, in a box's cell space at `light` (a point) or along it, leaves the box through
// an edge: to both sides of it by another face. The four edges along axis a, b and c being the others.
static inline void edge_kinks(LitSteps* k, const float* o, const float* d, const float* light, int is_point,
                              const float* lo, const float* hi, int a, float length) {
  const int b = (a + 1) % 3, c = (a + 2) % 3;
  for (int e = 0; e < 4; ++e) {
    const float edge_b = e & 1 ? hi[b] : lo[b], edge_c = e & 2 ? hi[c] : lo[c];
    const float to_b = is_point ? edge_b - light[b] : light[b], to_c = is_point ? edge_c - light[c] : light[c];
    const float s = ((o[c] - edge_c) * to_b - (o[b] - edge_b) * to_c) / (d[b] * to_c - d[c] * to_b);
    if (!(s > 0.0f && s < length)) continue;
    float at[3], way[3];
    for (int i = 0; i < 3; ++i) {
      at[i] = mad_exact(s, d[i], o[i]);
      way[i] = is_point ? light[i] - at[i] : light[i];
    }
    const float u = fabs(way[b]) > fabs(way[c]) ? (edge_b - at[b]) / way[b] : (edge_c - at[c]) / way[c];
    const float met = mad_exact(u, way[a], at[a]);
    if (u > 0.0f && (!is_point || u < 1.0f) && met >= lo[a] && met <= hi[a]) kink_add(k, s, length);
  }
}

static inline void box_kinks(LitSteps* k, const Medium* medium, const Light* light, float3 point, float3 dir,
                             float length) {
  float o[3], d[3], lo[3], hi[3], to[3];
  const int is_point = light->type != LIGHT_DIRECTIONAL;
  const float3 position = vec_unpack(light->position) * ldexp(1.0f, light->exponent);
  vstore3(affine_point(&medium->cell_from_world, point), 0, o);
  vstore3(affine_dir(&medium->cell_from_world, dir), 0, d);
  vstore3(vec_unpack(medium->lo), 0, lo);
  vstore3(vec_unpack(medium->hi), 0, hi);
  vstore3(is_point ? affine_point(&medium->cell_from_world, position)
                   : affine_dir(&medium->cell_from_world, -vec_unpack(light->direction)),
          0, to);
  for (int a = 0; a < 3; ++a) edge_kinks(k, o, d, to, is_point, lo, hi, a, length);
}

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
  k.count = 0;
  k.s = 0.0f;
  k.next = 0;
  if (!LIGHTS_ALL(scene)) return k;
  const float length = stretch->ray->length;
  const float3 point = vec_point(stretch->origin, stretch->dir, stretch->ray->t_begin);
  for (int l = 0; l < scene->frame->light_count && k.count < KINKS_MAX; ++l) {
    const Light light = scene->lights[l];
    if (!LIGHT_IS(&light, SPOT) || light.exponent != 0) continue;
    const float3 from = point - vec_unpack(light.position), axis = vec_unpack(light.direction);
    for (int i = 0; i <= CONES; ++i) {
      const float share = (float)i / (float)CONES;
      cone_kinks(&k, from, stretch->dir, axis, mad_exact(share, light.inner - light.outer, light.outer), length);
    }
  }
  for (int other = 0; other < MEDIA_END(scene); ++other) {
    const Medium medium = scene->media[other];
    if (other != m) {
      const MediumRay ray = medium_ray(&medium, stretch->origin, stretch->dir, stretch->t_max);
      const float begin = ray.t_begin - stretch->ray->t_begin;
      if (ray.length > 0.0f) kink_add(&k, begin, length);
      if (ray.length > 0.0f) kink_add(&k, begin + ray.length, length);
    }
    if (medium.region != REGION_BOX) continue;
    for (int l = 0; l < scene->frame->light_count && k.count < KINKS_MAX; ++l) {
      const Light light = scene->lights[l];
      box_kinks(&k, &medium, &light, point, stretch->dir, length);
    }
  }
  return k;
}

// How long the segment that begins at s may be, if nothing happens before `end`.
static inline float lit_step(const Scene* scene, const Stretch* stretch, const LitSteps* k, float end) {
  const float step = stretch->medium->step;
  if (!LIGHTS_ALL(scene)) return step;
  const float t = stretch->ray->t_begin + k->s;
  const float3 middle = vec_point(stretch->origin, stretch->dir, t + 0.5f * fmin(end - k->s, step));
  int lit = k->count == KINKS_MAX;  // a cone may have been left out
  float longest = step;
  for (int l = 0; l < scene->frame->light_count; ++l) {
    const Light light = scene->lights[l];
    if (LIGHT_IS(&light, SPOT) && light.exponent == 0 &&
        !(vec_max(light_sample(scene, l, middle, stretch->random).irradiance) > 0.0f))
      continue;
    lit = 1;
    if (LIGHT_IS(&light, DIRECTIONAL) || light.exponent != 0) continue;
    longest = fmin(longest, LIGHT_GRADE * light_apart(stretch, &light, k->s));
  }
  return lit ? fmax(longest, GRADE_FINEST * step) : INFINITY;
}

static inline void lit_steps_fill(const Scene* scene, const Stretch* stretch, LitSteps* k, Segments* out) {
  const float length = stretch->ray->length, apart = KINK_APART * length;
  int n = 0;
  for (; n < W && k->s < length; ++n) {
    float end = length;
    for (int i = 0; i < k->count; ++i)
      if (k->kink[i] > k->s + apart) end = fmin(end, k->kink[i]);
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
