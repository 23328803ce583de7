// Each hit under the lights: what is not blocked by surfaces and weakened by the media on the way, scattered towards
// the ray; and the rays that the hit sends on.
#include "path/ambient_occlusion.cl"
#include "path/send_on.cl"
#include "path/surface_light.cl"

OUTLINED SurfaceResult surface_result(const Scene* scene, const Ray* ray, const Hit* hit, float3 transmittance,
                                      int sends, __global Ray* sent) {
  SurfaceResult result;
  result.lit = result.lookups = result.shadow_rays = result.sent = result.dropped_rays = 0;
  result.dropped_weight = 0.0f;
  const Surface surface = surface_at(scene, ray, hit);
  const Material material = scene->materials[surface.material];
  result.normal = vec_pack(surface.normal);
#if BRUME_AMBIENT_OCCLUSION
  if (scene->frame->directions > 0) {
    result.second = 0;
    result.radiance = vec_pack(ambient_occlusion(scene, ray, &surface, &result));
    return result;
  }
#endif
  const float3 weight = vec_unpack(ray->weight) * transmittance;
  result.radiance = vec_pack(
      surface_lights(scene, &surface, hit, &material, -vec_unpack(ray->dir), weight, ray_random(ray), &result));
#if BRUME_SPECULAR
  if (sends) rays_send(scene, ray, &surface, &material, weight, sent, &result);
#endif
  return result;
}

// `wave`: how many surfaces the rays have met before.
__kernel void shadow_transmittance(SCENE_ARGS, uint wave, uint count, __global const Ray* rays,
                                   __global const Hit* hits, __global const MediumResult* results,
                                   __global SurfaceResult* surfaces, __global Ray* sent) {
  const uint item = (uint)get_global_id(0);
  if (item >= count || hits[item].primitive == PRIMITIVE_NONE) return;
  const Scene scene = SCENE_PACK;
  const Ray ray = rays[item];
  const Hit hit = hits[item];
  surfaces[item] = surface_result(&scene, &ray, &hit, vec_unpack(results[item].transmittance),
                                  (int)wave < frame->max_depth, sent + (size_t)SENT_MAX * item);
}
