// Surfaces under lights: what arrives from one light at a hit, and what the hit sends on of it.
#ifndef BRUME_RADIANCE_SHADING_CL
#define BRUME_RADIANCE_SHADING_CL
#include "radiance/material.cl"
#include "radiance/radiative.cl"

static inline LightArrival surface_arrival(const Scene* scene, const Surface* surface, int l, Random random,
                                           uint* lookups) {
  LightArrival arrival;
  arrival.lit = 0;
  arrival.transmittance = vec_pack((float3)(0.0f));
  const LightSample light = light_sample(scene->lights, l, surface->point);
  const float3 to_light = -light.travel;
  const float3 from = surface_leave(surface, to_light);
  if (dot(surface->normal, to_light) > 0.0f && !scene_occluded(scene, from, to_light, light.distance)) {
    arrival.lit = 1;
    arrival.transmittance = vec_pack(media_transmittance(scene, from, to_light, light.distance,
                                                         random_stream(random, STREAM_LIGHT + (uint)l), lookups));
  }
  return arrival;
}

// A hit about to be shaded: its own light first, then one light after another.
typedef struct {
  Surface surface;
  Material material;
  float3 diffuse, dir;  // dir: of the ray that hit
  float3 radiance;
  uint lit, second;
} Shading;

static inline Shading shading_begin(const Scene* scene, const Ray* ray, const Hit* hit) {
  Shading s;
  s.surface = surface_at(scene, ray, hit);
  s.material = scene->materials[s.surface.material];
  uint second;
  s.diffuse = material_diffuse(scene, &s.material, s.surface.uv, &s.second);
  s.dir = vec_unpack(ray->dir);
  s.radiance = material_emission(scene, &s.material, s.surface.uv, &second) +
               vec_unpack(s.material.ambient) * vec_unpack(scene->frame->ambient);
  s.second |= second;
  s.lit = 0;
  return s;
}

static inline void shading_add_light(const Scene* scene, Shading* s, int l, const LightArrival* arrival) {
  if (!arrival->lit) return;
  s->lit |= 1u << (l & 31);
  const LightSample light = light_sample(scene->lights, l, s->surface.point);
  s->radiance += light.irradiance * vec_unpack(arrival->transmittance) *
                 material_reflect(&s->material, s->diffuse, s->surface.normal, -light.travel, -s->dir);
}

static inline uint shading_key(int primitive, uint lit, uint shadow_key, uint second) {
  return (uint)primitive * 0x9E3779B1u + lit * 0x85EBCA6Bu + shadow_key * 0xC2B2AE35u + second * 0x27D4EB2Fu;
}

#endif
