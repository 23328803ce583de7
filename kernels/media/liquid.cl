// What a liquid sends along a view ray by local lighting: where its presence changes between `outside` and `inside`, it
// scatters the light of all lights as a surface does, across its gradient (PICTURE, Liquids).
#ifndef BRUME_MEDIA_LIQUID_CL
#define BRUME_MEDIA_LIQUID_CL
#include "media/stretch.cl"

#if BRUME_LIQUID

// Of the logarithm of a highlight: less is not seen.
#define LOBE_DARK -16.0f

// Differences of presences about a point of cell space, along x, y and z, and the presence itself.
static inline float4 gradient_at(const Scene* scene, const Medium* medium, int shift, float3 p) {
  const int x = clamp((int)p.x, 0, medium->cells_x - 1), y = clamp((int)p.y, 0, medium->cells_y - 1),
            z = clamp((int)p.z, 0, medium->cells_z - 1);
  const int bx = x / BRICK_CELLS, by = y / BRICK_CELLS, bz = z / BRICK_CELLS;
  const int number = brick_entry(scene, medium, bx, by, bz);
  if (number == BRICK_EMPTY) return (float4)(0.0f);
  if (scene->gradient_bricks[number + shift].medium < 0)  // of one value
    return (float4)(0.0f, 0.0f, 0.0f, vload2(number, scene->ranges).x);
  const int in_brick = brick_stride(x - BRICK_CELLS * bx, y - BRICK_CELLS * by, z - BRICK_CELLS * bz);
  __global const Voxel* first = scene->gradients + 4 * ((size_t)(number + shift) * BRICK_VALUES + (size_t)in_brick);
  const float fx = p.x - (float)x, fy = p.y - (float)y, fz = p.z - (float)z;
#define ALONG_X(out, offset)                                                                     \
  const float4 out##_a = LOAD4_VOXEL(offset, first), out##_b = LOAD4_VOXEL((offset) + 1, first); \
  const float4 out = mad_exact((float4)(fx), out##_b - out##_a, out##_a)
  ALONG_X(v00, 0);
  ALONG_X(v10, brick_stride(0, 1, 0));
  ALONG_X(v01, brick_stride(0, 0, 1));
  ALONG_X(v11, brick_stride(0, 1, 1));
#undef ALONG_X
  const float4 v0 = mad_exact((float4)(fy), v10 - v00, v00), v1 = mad_exact((float4)(fy), v11 - v01, v01);
  const float4 v = mad_exact((float4)(fz), v1 - v0, v0);
#if BRUME_STORAGE == 2
  const float2 scale = brick_scale(scene, number);
  return (float4)((v.xyz - 128.0f) * (1.0f / GRADIENT_PARTS), mad_exact(v.w, scale.y, scale.x));
#else
  return v;
#endif
}

// From differences in cell space to the unit normal of the world, out of the liquid; 0 where there is none.
static inline float3 liquid_normal(const Medium* medium, float3 gradient) {
  const float3 outwards = -affine_normal(&medium->cell_from_world, gradient);
  return vec_max_abs(outwards) > 0.0f ? vec_unit(outwards) : (float3)(0.0f);
}

// The face of the medium's box through which a ray passes at point p of cell space, as a gradient.
static inline float3 box_gradient(const Medium* medium, float3 p) {
  const float3 lo = vec_unpack(medium->lo), hi = vec_unpack(medium->hi);
  const float3 from_lo = fabs(p - lo), from_hi = fabs(hi - p), from = fmin(from_lo, from_hi);
  const float nearest = vec_min(from);
  if (from.x == nearest) return (float3)(from_lo.x < from_hi.x ? 1.0f : -1.0f, 0.0f, 0.0f);
  if (from.y == nearest) return (float3)(0.0f, from_lo.y < from_hi.y ? 1.0f : -1.0f, 0.0f);
  return (float3)(0.0f, 0.0f, from_lo.z < from_hi.z ? 1.0f : -1.0f);
}

// A view ray through a liquid and what it has met so far.
typedef struct {
  const Liquid* liquid;
  Stretch stretch;
  Others others;
  Tau tau, sigma_t;  // of the liquid up to the steps at work
} LiquidRay;

// Where it meets light.
typedef struct {
  float s;
  float light;  // how much of what arrives it sends
  float depth;  // ∫ρ of the liquid from where the steps at work begin
  float3 gradient;
  uint id;
} LiquidPlace;

// What the place at s with this normal sends back along the ray.
static inline float3 liquid_light(const Scene* scene, const LiquidRay* r, float s, float3 normal, uint id) {
  const Liquid* liquid = r->liquid;
  const float3 point = vec_point(r->stretch.origin, r->stretch.dir, r->stretch.ray->t_begin + s);
  const float3 to_viewer = -r->stretch.dir;
  float3 sum = vec_unpack(liquid->ambient) * vec_unpack(scene->frame->ambient);
  const int seen = dot(normal, to_viewer) > 0.0f && vec_max(vec_unpack(liquid->specular)) > 0.0f;
  const float xi = light_choice(r->stretch.walk, id);
  for (int n = 0; n < scene->frame->light_picks; ++n) {
    const LightPick pick = light_choose(scene, n, xi);
    const LightSample light = light_sample(scene, pick.light, point, r->stretch.random);
    const float cosine = dot(normal, -light.travel);
    if (!(cosine > 0.0f)) continue;
    float3 sent = cosine * vec_unpack(liquid->diffuse);
    if (seen) {
      const float half_way = dot(normal, normalize(to_viewer - light.travel));
      if (liquid->shininess * (half_way - 1.0f) > LOBE_DARK && half_way > 0.0f)
        sent += vec_unpack(liquid->specular) * exp(liquid->shininess * log(half_way));
    }
    sum += pick.weight * light.irradiance * sent;
  }
  return sum;
}

#if BRUME_MEDIA >= 2
static inline Tau others_tau(float others[TAU_CHANNELS][W], int i) {
#if BRUME_COLOR_TAU
  return (float3)(others[0][i], others[1][i], others[2][i]);
#else
  return others[0][i];
#endif
}

// Depth of the other media up to places, in their order along the ray: as segments without length.
OUTLINED void liquid_others(const Scene* scene, LiquidRay* r, int m, const LiquidPlace* places, int count,
                            float others[TAU_CHANNELS][W], MediumResult* result) {
  Stretch* s = &r->stretch;
  Segments at;
  at.count = W;
  for (int i = 0; i < W; ++i) {
    const LiquidPlace* place = places + min(i, count - 1);
    at.begin[i] = at.place[i] = place->s;
    at.size[i] = 0.0f;
    s->integral[i] = i < count ? 1.0f : 0.0f;
#if BRUME_RANDOM
    at.id[i] = s->id[i] = place->id;
#endif
  }
  s->at = &at;
  stretch_others(scene, s, m, m + 1, &r->others, &result->lookups);
  for (int c = 0; c < TAU_CHANNELS; ++c) lanes_store(s->others[c], others[c]);
}
#endif

// Adds the light of up to W places.
static inline void liquid_shine(const Scene* scene, LiquidRay* r, int m, const LiquidPlace* places, int count,
                                LongSum* radiance, MediumResult* result) {
#if BRUME_MEDIA >= 2
  float others[TAU_CHANNELS][W];
  liquid_others(scene, r, m, places, count, others, result);
#else
  (void)m;
  (void)result;
#endif
  for (int i = 0; i < count; ++i) {
    const LiquidPlace* place = places + i;
    const float3 sent = liquid_light(scene, r, place->s, liquid_normal(r->stretch.medium, place->gradient), place->id);
    Tau tau = r->tau + r->sigma_t * place->depth;
#if BRUME_MEDIA >= 2
    tau += others_tau(others, i);
#endif
    long_sum_add(radiance, place->light * sent * exp(-tau));
  }
}

// How much light the steps scatter: by the change of the presence between outside and inside, or by the way there.
static inline floatW liquid_lit(const Liquid* liquid, const PresenceSteps* at) {
  const floatW outside = (floatW)(liquid->outside), inside = (floatW)(liquid->inside);
  const floatW a = fmin_ordered(fmax_ordered(at->before, outside), inside);
  const floatW b = fmin_ordered(fmax_ordered(at->after, outside), inside);
  if (!(liquid->rate > 0.0f)) return fabs(b - a);
  const intW still = at->before == at->after;
  const floatW part = lanes_select((b - a) / (at->after - at->before), (floatW)(1.0f), still);
  const intW counts = !still | ((at->before >= outside) & (at->before <= inside));
  return lanes_select((floatW)(0.0f), part * at->size * liquid->rate, counts);
}

// The place of a step whose presence goes from a to b: where it is in the middle of what it changes by, as a share of
// the step, found by two steps of the false position; and its gradient.
static inline float liquid_place(const Scene* scene, const LiquidRay* r, float begin, float size, float a, float b,
                                 float3* gradient) {
  const Liquid* liquid = r->liquid;
  const MediumRay* ray = r->stretch.ray;
  const float middle = 0.5f * (clamp(a, liquid->outside, liquid->inside) + clamp(b, liquid->outside, liquid->inside));
  const int even = a == b;
  float u = even ? 0.5f : (middle - a) / (b - a);
  float4 found = gradient_at(scene, r->stretch.medium, liquid->gradients,
                             vec_point(ray->origin, ray->dir, mad_exact(u, size, begin)));
  if (!even) {
    const int before = (found.w - middle) * (b - middle) > 0.0f;  // the place is
    const float closer =
        before ? u * (middle - a) / (found.w - a) : mad_exact(1.0f - u, (middle - found.w) / (b - found.w), u);
    if (closer >= 0.0f && closer <= 1.0f) u = closer;  // else presences too much alike
    found = gradient_at(scene, r->stretch.medium, liquid->gradients,
                        vec_point(ray->origin, ray->dir, mad_exact(u, size, begin)));
  }
  *gradient = found.xyz;
  return u;
}

static inline float mean_above(float a, float b, float outside) {
  const float above_a = fmax(a, outside), above_b = fmax(b, outside), mean = 0.5f * (above_a + above_b);
  if (a >= outside && b >= outside) return mean;
  return a >= outside || b >= outside ? mean * ((above_b - above_a) / (b - a)) : 0.0f;
}

// The light of W steps, of which some have any. integral: ∫ρ over each.
OUTLINED void liquid_steps(const Scene* scene, LiquidRay* r, int m, const PresenceSteps* at, floatW lit,
                           floatW integral, LongSum* radiance, MediumResult* result) {
  float begin[W], size[W], before[W], after[W], light[W], depth[W], number[W];
  LiquidPlace places[W];
  int count = 0;
  lanes_store(at->begin, begin);
  lanes_store(at->size, size);
  lanes_store(at->before, before);
  lanes_store(at->after, after);
  lanes_store(at->number, number);
  lanes_store(lit, light);
  (void)integral;  // with one lane there are none before
  lanes_store(lanes_before(integral), depth);
  for (int i = 0; i < W; ++i) {
    if (!(light[i] > 0.0f)) continue;
    LiquidPlace* place = places + count++;
    const float u = liquid_place(scene, r, begin[i], size[i], before[i], after[i], &place->gradient);
    const float there = mad_exact(u, after[i] - before[i], before[i]);
    place->s = mad_exact(u, size[i], begin[i]);
    place->depth = mad_exact(u * size[i], mean_above(before[i], there, r->liquid->outside), depth[i]);
    place->light = light[i];
    place->id = (uint)number[i];
    result->lookups += before[i] == after[i] ? 1 : 2;
  }
  liquid_shine(scene, r, m, places, count, radiance, result);
}

// The light where the ray passes through a face of the medium's box at s, behind which the presence is 0.
OUTLINED void liquid_face(const Scene* scene, LiquidRay* r, int m, float s, float presence, uint id, LongSum* radiance,
                          MediumResult* result) {
  const MediumRay* ray = r->stretch.ray;
  LiquidPlace place;
  place.s = s;
  place.light = clamp(presence, r->liquid->outside, r->liquid->inside) - r->liquid->outside;
  place.depth = 0.0f;
  place.gradient = box_gradient(r->stretch.medium, vec_point(ray->origin, ray->dir, s));
  place.id = id;
  if (place.light > 0.0f && !(r->liquid->rate > 0.0f)) liquid_shine(scene, r, m, &place, 1, radiance, result);
}

// Medium m, a liquid, along a view ray up to t_max: adds what it sends to the origin to *radiance and returns its
// optical depth.
OUTLINED Tau liquid_scatter(const Scene* scene, int m, float3 origin, float3 dir, float t_max, Random random,
                            LongSum* radiance, MediumResult* result) {
  const Medium medium = scene->media[m];
  const Liquid liquid = scene->liquids[medium.liquid];
  const MediumRay ray = medium_ray(&medium, origin, dir, t_max);
  LiquidRay r;
  r.tau = (Tau)(0.0f);
  if (!(ray.length > 0.0f)) return r.tau;
  r.liquid = &liquid;
  r.sigma_t = medium_sigma_t(&medium);
  r.stretch.medium = &medium;
  r.stretch.ray = &ray;
  r.stretch.origin = origin;
  r.stretch.dir = dir;
  r.stretch.t_max = t_max;
  r.stretch.random = random;
  r.stretch.walk = random_stream(random, (uint)m);
  r.others.s = -ray.t_begin;
  r.others.tau = (Tau)(0.0f);
  Presence walk = presence_begin(scene, &medium, &ray);
  PresenceSteps at;
  int first = 1;
  while (tau_min(r.tau) < TAU_STOP && presence_next(scene, &medium, &ray, &walk, &at)) {
    if (first && lanes_first(at.number) == 0.0f && ray.t_begin > 0.0f)
      liquid_face(scene, &r, m, 0.0f, lanes_first(at.after), 0, radiance, result);
    first = 0;
    const floatW lit = liquid_lit(&liquid, &at), integral = presence_integral(&walk, &at);
    result->lookups += (uint)at.count;
    if (lanes_any(lit > (floatW)(0.0f))) liquid_steps(scene, &r, m, &at, lit, integral, radiance, result);
    r.tau += r.sigma_t * lanes_sum(integral);
  }
  const int leaves = walk.next > walk.last && ray.t_begin + ray.length < t_max * (1.0f - 1e-6f);
  if (leaves) liquid_face(scene, &r, m, ray.length, walk.presence, (uint)walk.last + 1u, radiance, result);
  return r.tau;
}

#endif
#endif
