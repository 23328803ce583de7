// Adds what the rays of a wave bring to their samples: surface or background seen through the media. Item = sample; of
// a sample always in the same order, whatever else the wave holds.
#include "lights/lights.cl"

static inline uint ray_key(__global const Hit* hit, uint lit, uint walked, uint second) {
  return primitive_name(hit->primitive, hit->instance) * 0x9E3779B1u + lit * 0x85EBCA6Bu + walked * 0xC2B2AE35u +
         second * 0x27D4EB2Fu;
}

static inline void sample_begin(uint item, __global Sample* s) {
  s->radiance = s->normal = s->transmittance = vec_pack((float3)(0.0f));
  s->depth = s->dropped_weight = s->error = 0.0f;
  s->key = s->lookups = s->shadow_rays = s->secondary_rays = s->dropped_rays = 0;
  s->hit = 0;
  s->first_ray = item;
  s->rays = 1;
}

static inline void sample_add_surface(__global Sample* s, __global const SurfaceResult* surface) {
  s->lookups += surface->lookups;
  s->shadow_rays += surface->shadow_rays;
  s->dropped_rays += surface->dropped_rays;
  s->dropped_weight += surface->dropped_weight;
}

// What one ray brings; counts, key and the camera ray's planes into the sample.
static inline float3 sample_add(const Scene* scene, __global const Ray* ray, __global const Hit* hit,
                                __global const MediumResult* medium, __global const SurfaceResult* surface, uint wave,
                                __global Sample* s) {
  const int hits = HAS_SURFACES && hit->primitive != PRIMITIVE_NONE;
  float3 behind = (float3)(0.0f);
  uint walked = medium->shadow_key, lit = 0, second = 0;
#if BRUME_TRACKING
  walked += medium->lookups + (hits ? surface->lookups : 0);
#endif
  if (hits) {
    behind = vec_unpack(surface->radiance);
    lit = surface->lit;
    second = surface->second;
    sample_add_surface(s, surface);
  } else if (wave > 0 || !scene->frame->hides_background) {
    behind = background_radiance(scene, vec_unpack(ray->dir));
  }
  if (wave == 0) {
    s->transmittance = medium->transmittance;
    s->hit = hits;
    if (hits) s->normal = surface->normal;
    if (hits) s->depth = ray->start + hit->t;
  }
  s->lookups += medium->lookups;
  s->shadow_rays += medium->shadow_rays;
  s->secondary_rays += wave > 0;
  s->key += ray_key(hit, lit, walked, second) * (2 * wave + 1);
  const float3 weight = vec_unpack(ray->weight), seen = vec_unpack(medium->transmittance) * behind;
  s->error += vec_mean(weight) * (medium->error + vec_mean(seen) * medium->tau_error);
  return weight * (vec_unpack(medium->radiance) + seen);
}

// Works on what lies in memory: copied there and back, the numbers of a sample would wait for each other. Returns how
// many rays its rays of this wave send on.
OUTLINED uint sample_shade(const Scene* scene, uint wave, __global const Ray* rays, __global const Hit* hits,
                           __global const MediumResult* results, __global const SurfaceResult* surfaces,
                           __global Sample* sample) {
  uint total = 0;
  const uint begin = sample->first_ray, end = begin + sample->rays;
  // What rounding takes is put back: of thousands of rays it would be seen [Kahan65].
  float3 sum = vec_unpack(sample->radiance), lost = (float3)(0.0f);
  for (uint i = begin; i < end; ++i) {
    const float3 next = sample_add(scene, rays + i, hits + i, results + i, surfaces + i, wave, sample) - lost;
    const float3 before = sum;
    sum = before + next;
    lost = (sum - before) - next;
    if (HAS_SURFACES && hits[i].primitive != PRIMITIVE_NONE) total += surfaces[i].sent;
  }
  sample->radiance = vec_pack(sum);
  return total;
}

// sent: of each sample, how many rays its rays of this wave send on; before, those of the wave before.
__kernel void shade(SCENE_ARGS, uint wave, uint count, __global const Ray* rays, __global const Hit* hits,
                    __global const MediumResult* results, __global const SurfaceResult* surfaces,
                    __global Sample* samples, __global uint* sent) {
  const uint item = (uint)get_global_id(0);
  if (item >= count) return;
#if BRUME_SPECULAR
  if (wave > 0 && sent[item] == 0) return;
#endif
  const Scene scene = SCENE_PACK;
  if (wave == 0) sample_begin(item, samples + item);
  const uint total = sample_shade(&scene, wave, rays, hits, results, surfaces, samples + item);
#if BRUME_SPECULAR
  sent[item] = total;
#endif
}
