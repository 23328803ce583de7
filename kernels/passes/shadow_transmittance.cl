// What reaches each hit from each light: blocked by surfaces, else weakened by the media on the way.
#include "radiance/radiative.cl"
#include "radiance/surface.cl"

__kernel void shadow_transmittance(SCENE_ARGS, uint count, __global const Ray* rays, __global const Hit* hits,
                                   __global MediumResult* results, __global LightArrival* arrivals) {
  const uint item = (uint)get_global_id(0);
  if (item >= count || hits[item].primitive == PRIMITIVE_NONE) return;
  const Scene scene = SCENE_PACK;
  const Ray ray = rays[item];
  const Hit hit = hits[item];
  const Surface surface = surface_at(&scene, &ray, &hit);
  uint lookups = 0;
  for (int l = 0; l < frame->light_count; ++l) {
    LightArrival arrival;
    arrival.lit = 0;
    arrival.transmittance = vec_pack((float3)(0.0f));
    const LightSample light = light_sample(lights, l, surface.point);
    const float3 to_light = -light.travel;
    const float3 from = surface_leave(&surface, to_light);
    if (dot(surface.normal, to_light) > 0.0f && !scene_occluded(&scene, from, to_light, light.distance)) {
      arrival.lit = 1;
      arrival.transmittance = vec_pack(media_transmittance(&scene, from, to_light, light.distance, &lookups));
    }
    arrivals[(size_t)l * count + item] = arrival;
  }
  results[item].lookups += lookups;
  results[item].shadow_rays += (uint)frame->light_count;
}
