// Surface or background seen through the media: one finished sample per ray.
#include "lib/light.cl"
#include "radiance/material.cl"

__kernel void shade(SCENE_ARGS, uint count, __global const Ray* rays, __global const Hit* hits,
                    __global const MediumResult* results, __global const LightArrival* arrivals,
                    __global Sample* samples) {
  const uint item = (uint)get_global_id(0);
  if (item >= count) return;
  const Scene scene = SCENE_PACK;
  const MediumResult medium = results[item];
  float3 behind = vec_unpack(frame->background);
  float3 normal = (float3)(0.0f);
  uint lit = 0, second = 0;
#if HAS_SURFACES
  const Hit hit = hits[item];
  if (hit.primitive != PRIMITIVE_NONE) {
    const Ray ray = rays[item];
    const Surface surface = surface_at(&scene, &ray, &hit);
    const Material material = materials[surface.material];
    const float3 diffuse = material_diffuse(&scene, &material, surface.uv, &second);
    normal = surface.normal;
    behind = vec_unpack(material.emission) + vec_unpack(material.ambient) * vec_unpack(frame->ambient);
    for (int l = 0; l < frame->light_count; ++l) {
      const LightArrival arrival = arrivals[(size_t)l * count + item];
      if (!arrival.lit) continue;
      lit |= 1u << (l & 31);
      const LightSample light = light_sample(lights, l, surface.point);
      behind += light.irradiance * vec_unpack(arrival.transmittance) *
                material_reflect(&material, diffuse, normal, -light.travel, -vec_unpack(ray.dir));
    }
  }
#endif
  Sample sample;
  sample.radiance = vec_pack(vec_unpack(medium.radiance) + vec_unpack(medium.transmittance) * behind);
  sample.key = (uint)hits[item].primitive * 0x9E3779B1u + lit * 0x85EBCA6Bu + medium.shadow_key * 0xC2B2AE35u +
               second * 0x27D4EB2Fu;
  sample.normal = vec_pack(normal);
  sample.pad = 0.0f;
  samples[item] = sample;
}
