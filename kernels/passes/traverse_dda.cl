// What the media do to each ray between its origin and its hit: transmittance and in-scattered radiance.
#include "media/scatter.cl"

__kernel void traverse_dda(SCENE_ARGS, uint count, __global const Ray* rays, __global const Hit* hits,
                           __global MediumResult* results) {
  const uint item = (uint)get_global_id(0);
  if (item >= count) return;
  const Scene scene = SCENE_PACK;
  const Ray ray = rays[item];
  results[item] = media_scatter(&scene, vec_unpack(ray.origin), vec_unpack(ray.dir), hits[item].t, ray_random(&ray));
}
