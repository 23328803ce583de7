// What the media do to each ray between its origin and its hit: transmittance and in-scattered radiance. What a shape
// that refracts absorbs of what lies behind is part of the transmittance.
#include "materials/inside.cl"
#include "media/scatter.cl"

__kernel void traverse_dda(SCENE_ARGS, uint count, __global const Ray* rays, __global const Hit* hits,
                           __global MediumResult* results) {
  const uint item = (uint)get_global_id(0);
  if (item >= count) return;
  if (!hits[item].in_media && !(BRUME_SPECULAR && rays[item].inside[0] >= 0)) {
    results[item] = medium_result_none();
    return;
  }
  const Scene scene = SCENE_PACK;
  const Ray ray = rays[item];
  MediumResult result =
      media_scatter(&scene, vec_unpack(ray.origin), vec_unpack(ray.dir), hits[item].t, ray_random(&ray));
#if BRUME_SPECULAR
  if (ray.inside[0] >= 0)
    result.transmittance =
        vec_pack(vec_unpack(result.transmittance) * inside_transmittance(&scene, ray.inside, ray.start + hits[item].t));
#endif
  results[item] = result;
}
