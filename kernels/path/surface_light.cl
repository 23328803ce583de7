// What a surface sends towards the ray that hit it: its own light, and what it scatters of the lights that reach it.
#ifndef BRUME_PATH_SURFACE_LIGHT_CL
#define BRUME_PATH_SURFACE_LIGHT_CL
#include "lights/lights.cl"
#include "materials/glass.cl"
#include "materials/material.cl"
#include "media/tau.cl"

// The light of a shadow ray and where the ray begins; 0 where the light comes from behind, or lies in the plane of the
// surface but for what its point was rounded by: so do neighbours of a solid that emits, along the edge.
static inline int shadow_ray(const Scene* scene, const Surface* surface, LightPick pick, Random random,
                             LightSample* light, float3* from) {
  *light = light_sample(scene, pick.light, surface->point, random);
  *from = surface_leave(surface, -light->travel);
  const float height = fabs(light->distance * dot(surface->geometric_normal, light->travel));
  return dot(surface->normal, -light->travel) > 0.0f && !(height <= surface->epsilon);
}

// What it scatters of the light of shadow ray n; none where that comes from behind or something blocks it. `weight`: of
// that in the sample. Of what refracts, highlights are asked for where they count.
static inline float3 surface_light(const Scene* scene, const Surface* surface, const Material* material, float3 diffuse,
                                   float3 to_viewer, float3 weight, LightPick pick, int n, Random random,
                                   SurfaceResult* result) {
  LightSample light;
  float3 from;
  const int faces = shadow_ray(scene, surface, pick, random, &light, &from);
  const float3 to_light = -light.travel;
  ++result->shadow_rays;
  if (!faces) return (float3)(0.0f);
  const float3 scattered = material_reflect(material, diffuse, surface->normal, to_light, to_viewer);
  if (material->refraction > 0.0f && vec_max(weight * scattered) < scene->frame->cutoff) return (float3)(0.0f);
  const int known = n < 32 && (surface->asked >> n & 1);
  if (known && (surface->blocked >> n & 1)) return (float3)(0.0f);
  const float3 passes =
      known ? (float3)(1.0f) : light_passes(scene, from, to_light, light.reach, surface_gap(surface, to_light));
  if (!(vec_max(passes) > 0.0f)) return (float3)(0.0f);
  result->lit |= 1u << (pick.light & 31);
  const float3 transmittance = media_transmittance(scene, from, to_light, light.distance,
                                                   random_stream(random, STREAM_LIGHT + (uint)n), &result->lookups);
  return pick.weight * light.irradiance * passes * transmittance * scattered;
}

// Its own light and what it scatters of all lights that are asked.
static inline float3 surface_sends(const Scene* scene, const Surface* surface, const Material* material,
                                   float3 to_viewer, float3 weight, Random random, SurfaceResult* result) {
  uint second;
  const float3 diffuse = texture_times(scene, material->diffuse, material->texture, surface->uv, &result->second);
  float3 sum = texture_times(scene, material->emission, material->emission_texture, surface->uv, &second) +
               vec_unpack(material->ambient) * vec_unpack(scene->frame->ambient);
  result->second |= second;
  const float xi = light_choice(random, 0);
  for (int n = 0; n < scene->frame->light_picks; ++n)
    sum += surface_light(scene, surface, material, diffuse, to_viewer, weight, light_choose(scene, n, xi), n, random,
                         result);
  return sum;
}

// Of a triangle that blends the light of its corners [Gouraud71], theirs.
static inline float3 surface_lights(const Scene* scene, const Surface* surface, const Hit* hit,
                                    const Material* material, float3 to_viewer, float3 weight, Random random,
                                    SurfaceResult* result) {
#if BRUME_GOURAUD && BRUME_TRIANGLES
  Triangle triangle;
  int corners = 1;
  if (hit->primitive >= FIRST_TRIANGLE) {
    float3 geometric;
    triangle = triangle_of(scene, hit->primitive, hit->instance, &geometric);
    if (triangle.shading == TRIANGLE_GOURAUD) corners = 3;
  }
  float3 sum = (float3)(0.0f);
  for (int k = 0; k < corners; ++k) {
    float share = 1.0f;
    const Surface at = corners == 1 ? *surface : surface_corner(scene, &triangle, hit, surface, k, &share);
    sum += share * surface_sends(scene, &at, material, to_viewer, weight, random, result);
  }
  return sum;
#else
  (void)hit;
  return surface_sends(scene, surface, material, to_viewer, weight, random, result);
#endif
}

#endif
