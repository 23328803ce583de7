// Reflected and refracted rays that a hit sends on [Whitted80].
#ifndef BRUME_PATH_SEND_ON_CL
#define BRUME_PATH_SEND_ON_CL
#include "lib/rng.cl"
#include "materials/inside.cl"

// `heirs`: its share of those of the ray that it comes from, itself included.
static inline void ray_send(const Scene* scene, __global const Ray* from, const Surface* surface, int refracts,
                            float3 dir, float3 weight, float heirs, uint seed, __global Ray* sent,
                            __global SurfaceResult* result) {
  if (!(vec_max(weight) > 0.0f)) return;
  if (!(heirs >= 1.0f) || vec_max(weight) < scene->frame->cutoff) {
    ++result->dropped_rays;
    result->dropped_weight += vec_max(weight);
    return;
  }
  const float3 unit = normalize(dir);
  __global Ray* ray = sent + result->sent++;
  ray->origin = vec_pack(surface_leave(surface, unit));
  ray->pixel = from->pixel;
  ray->dir = vec_pack(unit);
  ray->sample = from->sample;
  ray->weight = vec_pack(weight);
  ray->seed = seed;
  ray->heirs = heirs - 1.0f;
  ray->start = surface_gap(surface, unit);
  int inside[INSIDE_MAX];
  for (int i = 0; i < INSIDE_MAX; ++i) inside[i] = from->inside[i];
  if (refracts && dot(surface->geometric_normal, unit) < 0.0f) {
    if (surface->leaving)
      inside_leave(inside, surface->material);
    else
      inside_enter(inside, surface->material);
  }
  for (int i = 0; i < INSIDE_MAX; ++i) ray->inside[i] = inside[i];
}

// What is not refracted is mirrored: all of it where reflection is total, by Fresnel's equations a share of it.
static inline void rays_send(const Scene* scene, __global const Ray* ray, const Surface* surface,
                             const Material* material, float3 weight, __global Ray* sent,
                             __global SurfaceResult* result) {
  float reflection = material->reflection, refraction = material->refraction;
  const float3 n = surface->normal, d = vec_unpack(ray->dir);
  const float cosine = -dot(n, d), both = reflection + refraction;
  const Random random = {ray->pixel, ray->sample, ray->seed};
  const int refracts = refraction > 0.0f;
  if (refracts) {
    const float eta = surface->leaving ? material->ior : 1.0f / material->ior;
    const float k = 1.0f - eta * eta * (1.0f - cosine * cosine);
    const float mirrored = material->fresnel ? fresnel_reflectance(fmax(cosine, 0.0f), eta) : (k >= 0.0f ? 0.0f : 1.0f);
    reflection += refraction * mirrored;
    refraction *= 1.0f - mirrored;
    if (refraction > 0.0f)
      ray_send(scene, ray, surface, refracts, eta * d + (eta * cosine - sqrt(k)) * n, weight * refraction,
               ray->heirs * (refraction / both), random_stream(random, STREAM_REFRACT).seed, sent, result);
  }
  if (reflection > 0.0f)
    ray_send(scene, ray, surface, refracts, d + 2.0f * cosine * n, weight * reflection,
             ray->heirs * (reflection / both), random_stream(random, STREAM_REFLECT).seed, sent, result);
}

#endif
