// Each hit under the lights: what is not blocked by surfaces and weakened by the media on the way, scattered towards
// the ray; and the rays that the hit sends on.
#include "path/ambient_occlusion.cl"
#include "path/send_on.cl"
#include "path/surface_light.cl"

static inline void result_begin(float3 normal, __global SurfaceResult* result) {
  result->normal = vec_pack(normal);
  result->lit = result->second = result->lookups = result->shadow_rays = result->sent = result->dropped_rays = 0;
  result->dropped_weight = 0.0f;
}

// What the ray finds; 0 where no light is asked for it.
OUTLINED int surface_begin(const Scene* scene, __global const Ray* ray, const Hit* hit, float3 transmittance,
                           LitSurface* lit, __global SurfaceResult* result) {
  const float3 dir = vec_unpack(ray->dir);
  surface_at(scene, vec_unpack(ray->origin), dir, hit, &lit->at);
  result_begin(lit->at.normal, result);
#if BRUME_AMBIENT_OCCLUSION
  if (scene->frame->directions > 0) {
    result->radiance = vec_pack(ambient_occlusion(scene, ray, &lit->at, result));
    return 0;
  }
#endif
  lit->material = scene->materials[lit->at.material];
  lit->to_viewer = -dir;
  lit->weight = vec_unpack(ray->weight) * transmittance;
  const Random random = {ray->pixel, ray->sample, ray->seed};
  lit->random = random;
  surface_glow(scene, lit, result);
#if BRUME_GOURAUD && BRUME_TRIANGLES
  if (surface_blends(scene, hit)) {
    surface_blend(scene, hit, lit, result);
    result->radiance = vec_pack(lit->sum);
    return 0;
  }
#endif
  return 1;
}

// Of the first `count` of up to SURFACES rays.
OUTLINED void surfaces_answer(const Scene* scene, uint wave, uint count, __global const Ray* rays,
                              __global const Hit* hits, __global const MediumResult* results,
                              __global SurfaceResult* surfaces, __global Ray* sent) {
  LitSurface lit[SURFACES];
  int met = 0;
  for (uint i = 0; i < min((uint)SURFACES, count); ++i) {
    const Hit hit = hits[i];
    if (hit.primitive == PRIMITIVE_NONE) continue;
    lit[met].ray = i;
    lit[met].asks = surface_begin(scene, rays + i, &hit, vec_unpack(results[i].transmittance), lit + met, surfaces + i);
    ++met;
  }
  surfaces_scatter(scene, lit, surfaces, met);
  for (int k = 0; k < met; ++k) {
    const uint i = lit[k].ray;
    if (lit[k].asks) surfaces[i].radiance = vec_pack(lit[k].sum);
#if BRUME_SPECULAR
    if ((int)wave < scene->frame->max_depth && scene->frame->directions == 0)
      rays_send(scene, rays + i, &lit[k].at, &lit[k].material, lit[k].weight, sent + (size_t)SENT_MAX * i,
                surfaces + i);
#endif
  }
}

// `wave`: how many surfaces the rays have met before. On a CPU one of several items works for all of them.
__kernel void shadow_transmittance(SCENE_ARGS, uint wave, uint count, __global const Ray* rays,
                                   __global const Hit* hits, __global const MediumResult* results,
                                   __global SurfaceResult* surfaces, __global Ray* sent) {
  const uint item = (uint)get_global_id(0);
  if (item >= count || item % SURFACES != 0) return;
  const Scene scene = SCENE_PACK;
  surfaces_answer(&scene, wave, count - item, rays + item, hits + item, results + item, surfaces + item,
                  sent + (size_t)SENT_MAX * item);
}
