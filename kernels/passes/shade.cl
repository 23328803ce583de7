// Surface or background seen through the media: one finished sample per ray.
#include "radiance/shading.cl"

__kernel void shade(SCENE_ARGS, uint count, __global const Ray* rays, __global const Hit* hits,
                    __global const MediumResult* results, __global const LightArrival* arrivals,
                    __global Sample* samples) {
  const uint item = (uint)get_global_id(0);
  if (item >= count) return;
  const Scene scene = SCENE_PACK;
  const MediumResult medium = results[item];
  float3 behind = frame->hides_background ? (float3)(0.0f) : vec_unpack(frame->background);
  float3 normal = (float3)(0.0f);
  float depth = 0.0f;
  uint lit = 0, second = 0, walked = medium.shadow_key;
#if BRUME_TRACKING
  walked += medium.lookups;  // as in media_scatter: those of the shadow rays from the hit too
#endif
#if HAS_SURFACES
  const Hit hit = hits[item];
  if (hit.primitive != PRIMITIVE_NONE) {
    const Ray ray = rays[item];
    Shading shading = shading_begin(&scene, &ray, &hit);
    for (int l = 0; l < frame->light_count; ++l) {
      const LightArrival arrival = arrivals[(size_t)l * count + item];
      shading_add_light(&scene, &shading, l, &arrival);
    }
    behind = shading.radiance;
    normal = shading.surface.normal;
    depth = ray.start + hit.t;
    lit = shading.lit;
    second = shading.second;
  }
#endif
  Sample sample;
  sample.radiance = vec_pack(vec_unpack(medium.radiance) + vec_unpack(medium.transmittance) * behind);
  sample.key = shading_key(hits[item].primitive, lit, walked, second);
  sample.normal = vec_pack(normal);
  sample.depth = depth;
  samples[item] = sample;
}
