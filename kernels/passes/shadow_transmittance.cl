// Each hit under the lights: what is not blocked by surfaces and weakened by the media on the way, scattered towards
// the ray; and the rays that the hit sends on.
#include "path/ambient_occlusion.cl"
#include "path/send_on.cl"
#include "path/shadows_together.cl"
#include "path/surface_light.cl"

OUTLINED SurfaceResult surface_result(const Scene* scene, const Ray* ray, const Hit* hit, const Surface* surface,
                                      float3 transmittance, int sends, __global Ray* sent) {
  SurfaceResult result;
  result.lit = result.lookups = result.shadow_rays = result.sent = result.dropped_rays = 0;
  result.dropped_weight = 0.0f;
  const Material material = scene->materials[surface->material];
  result.normal = vec_pack(surface->normal);
#if BRUME_AMBIENT_OCCLUSION
  if (scene->frame->directions > 0) {
    result.second = 0;
    result.radiance = vec_pack(ambient_occlusion(scene, ray, surface, &result));
    return result;
  }
#endif
  const float3 weight = vec_unpack(ray->weight) * transmittance;
  result.radiance =
      vec_pack(surface_lights(scene, surface, hit, &material, -vec_unpack(ray->dir), weight, ray_random(ray), &result));
#if BRUME_SPECULAR
  if (sends) rays_send(scene, ray, surface, &material, weight, sent, &result);
#endif
  return result;
}

// On a CPU the first of W items works for all of them, which ask for the same lights.
#if RAYS_TOGETHER
OUTLINED uint surfaces_ask(const Scene* scene, uint count, __global const Ray* rays, __global const Hit* hits,
                           Surface* surfaces) {
  uint there = 0;
  for (uint i = 0; i < min((uint)W, count); ++i) {
    const Ray ray = rays[i];
    const Hit hit = hits[i];
    if (hit.primitive == PRIMITIVE_NONE) continue;
    surfaces[i] = surface_at(scene, &ray, &hit);
    there |= 1u << i;
  }
  shadows_ask(scene, rays, there, surfaces);
  return there;
}
#endif

// `wave`: how many surfaces the rays have met before.
__kernel void shadow_transmittance(SCENE_ARGS, uint wave, uint count, __global const Ray* rays,
                                   __global const Hit* hits, __global const MediumResult* results,
                                   __global SurfaceResult* surfaces, __global Ray* sent) {
  const uint item = (uint)get_global_id(0);
  if (item >= count) return;
  const Scene scene = SCENE_PACK;
#if RAYS_TOGETHER
  if (item % W != 0) return;
  Surface met[W];
  const uint there = surfaces_ask(&scene, count - item, rays + item, hits + item, met);
#else
  Surface met[1];
  const uint there = hits[item].primitive != PRIMITIVE_NONE;
#endif
  for (uint i = 0; there >> i != 0; ++i) {
    if (!(there >> i & 1)) continue;
    const Ray ray = rays[item + i];
    const Hit hit = hits[item + i];
#if !RAYS_TOGETHER
    met[i] = surface_at(&scene, &ray, &hit);
#endif
    surfaces[item + i] = surface_result(&scene, &ray, &hit, &met[i], vec_unpack(results[item + i].transmittance),
                                        (int)wave < frame->max_depth, sent + (size_t)SENT_MAX * (item + i));
  }
}
