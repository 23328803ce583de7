// Reflected and refracted light [Whitted80]: follows the rays that each hit sends on, depth first, and adds what they bring to the sample.
// A small stack per item and not a launch per bounce: few pixels see a mirror, and a bounce through buffers would write and
// read some 150 bytes for every ray of the batch.
#include "radiance/shading.cl"

typedef struct {
  float3 origin, dir, weight;
  Random random;
  int depth;    // 1 for the rays of the first hit
  float heirs;  // how many rays it may send on, those that these send on included
} PathRay;

typedef struct {
  PathRay rays[BRUME_MAX_DEPTH + 1];  // each ray that is taken leaves at most two, one level deeper
  int count;
} PathStack;

// `heirs`: its share of those of the ray that it comes from, itself included.
static inline void path_push(PathStack* stack, const Surface* surface, float3 dir, float3 weight, float heirs,
                             Random random, int depth, MediumResult* sum) {
  if (!(vec_max(weight) > 0.0f)) return;
  if (!(heirs >= 1.0f)) {
    ++sum->dropped_rays;
    sum->dropped_weight += vec_max(weight);
    return;
  }
  PathRay ray;
  ray.dir = normalize(dir);
  ray.origin = surface_leave(surface, ray.dir);
  ray.weight = weight;
  ray.random = random;
  ray.depth = depth;
  ray.heirs = heirs - 1.0f;
  stack->rays[stack->count++] = ray;
}

// Where total reflection leaves no refracted ray, the reflected one takes its weight.
static inline void path_continue(const Scene* scene, PathStack* stack, const Shading* s, float3 weight, float heirs,
                                 Random random, int depth, MediumResult* sum) {
  if (depth > scene->frame->max_depth) return;
  float reflection = s->material.reflection, refraction = s->material.refraction;
  const float3 n = s->surface.normal, d = s->dir;
  const float cosine = -dot(n, d), both = reflection + refraction;
  if (refraction > 0.0f) {
    const float eta = s->surface.leaving ? s->material.ior : 1.0f / s->material.ior;
    const float k = 1.0f - eta * eta * (1.0f - cosine * cosine);
    if (k >= 0.0f) {
      path_push(stack, &s->surface, eta * d + (eta * cosine - sqrt(k)) * n, weight * refraction,
                heirs * (refraction / both), random_stream(random, STREAM_REFRACT), depth, sum);
    } else {
      reflection = both;
    }
  }
  if (reflection > 0.0f)
    path_push(stack, &s->surface, d + 2.0f * cosine * n, weight * reflection, heirs * (reflection / both),
              random_stream(random, STREAM_REFLECT), depth, sum);
}

// One ray of the stack: its light times its weight.
static inline float3 path_follow(const Scene* scene, PathStack* stack, MediumResult* sum, uint* key) {
  const PathRay path = stack->rays[--stack->count];
  Ray ray;
  ray.origin = vec_pack(path.origin);
  ray.dir = vec_pack(path.dir);
  ray.pixel = 0;
  ray.sample = 0;
  const Hit hit = scene_hit(scene, path.origin, path.dir, INFINITY, 0);
  const MediumResult medium = media_scatter(scene, path.origin, path.dir, hit.t, path.random);
  float3 behind = vec_unpack(scene->frame->background);
  uint lit = 0, second = 0, lookups = 0;
  if (hit.primitive != PRIMITIVE_NONE) {
    Shading shading = shading_begin(scene, &ray, &hit);
    for (int l = 0; l < scene->frame->light_count; ++l) {
      const LightArrival arrival = surface_arrival(scene, &shading.surface, l, path.random, &lookups);
      shading_add_light(scene, &shading, l, &arrival);
    }
    path_continue(scene, stack, &shading, path.weight * vec_unpack(medium.transmittance), path.heirs, path.random,
                  path.depth + 1, sum);
    behind = shading.radiance;
    lit = shading.lit;
    second = shading.second;
    sum->shadow_rays += (uint)scene->frame->light_count;
  }
  sum->shadow_rays += medium.shadow_rays;
  sum->lookups += medium.lookups + lookups;
  uint walked = medium.shadow_key;
#if BRUME_TRACKING
  walked += medium.lookups + lookups;
#endif
  ++sum->secondary_rays;
  *key += shading_key(hit.primitive, lit, walked, second) * (uint)(2 * path.depth + 1);
  return path.weight * (vec_unpack(medium.radiance) + vec_unpack(medium.transmittance) * behind);
}

__kernel void secondary_rays(SCENE_ARGS, uint count, __global const Ray* rays, __global const Hit* hits,
                             __global MediumResult* results, __global Sample* samples) {
  const uint item = (uint)get_global_id(0);
  if (item >= count || hits[item].primitive == PRIMITIVE_NONE) return;
  const Scene scene = SCENE_PACK;
  const Ray ray = rays[item];
  const Hit hit = hits[item];
  const Shading first = shading_begin(&scene, &ray, &hit);
  PathStack stack;
  stack.count = 0;
  MediumResult sum = results[item];
  const float heirs = frame->max_depth > SECONDARY_DEPTH_WHOLE ? (float)SECONDARY_RAYS_MAX : INFINITY;
  path_continue(&scene, &stack, &first, vec_unpack(sum.transmittance), heirs,
                random_begin(frame, ray.pixel, ray.sample), 1, &sum);
  if (stack.count == 0) return;
  float3 radiance = (float3)(0.0f);
  uint key = 0;
  while (stack.count > 0) radiance += path_follow(&scene, &stack, &sum, &key);
  results[item] = sum;
  samples[item].radiance = vec_pack(vec_unpack(samples[item].radiance) + radiance);
  samples[item].key += key;
}
