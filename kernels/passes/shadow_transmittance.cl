// What reaches each hit from each light: blocked by surfaces, else weakened by the media on the way.
#include "radiance/shading.cl"

__kernel void shadow_transmittance(SCENE_ARGS, uint count, __global const Ray* rays, __global const Hit* hits,
                                   __global MediumResult* results, __global LightArrival* arrivals) {
  const uint item = (uint)get_global_id(0);
  if (item >= count || hits[item].primitive == PRIMITIVE_NONE) return;
  const Scene scene = SCENE_PACK;
  const Ray ray = rays[item];
  const Hit hit = hits[item];
  const Surface surface = surface_at(&scene, &ray, &hit);
  const Random random = random_begin(frame, ray.pixel, ray.sample);
  uint lookups = 0;
  for (int l = 0; l < frame->light_count; ++l)
    arrivals[(size_t)l * count + item] = surface_arrival(&scene, &surface, l, random, &lookups);
  results[item].lookups += lookups;
  results[item].shadow_rays += (uint)frame->light_count;
}
