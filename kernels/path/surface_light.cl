// What surfaces send towards the rays that hit them: their own light, and what they scatter of the lights that reach
// them. Up to W of them side by side ask light by light, so that their shadow rays go together: surfaces of neighbours
// ask about the same way for a light without extent.
#ifndef BRUME_PATH_SURFACE_LIGHT_CL
#define BRUME_PATH_SURFACE_LIGHT_CL
#include "lights/lights.cl"
#include "materials/glass.cl"
#include "materials/material.cl"
#include "media/tau.cl"

#if RAYS_TOGETHER
#define SURFACES W
#define SHADOWS_LEAST (W / 4)  // of fewer shadow rays each goes through the triangles alone
#else
#define SURFACES 1
#endif

// A surface that is lit.
typedef struct {
  Surface at;
  Material material;
  float3 to_viewer;
  float3 weight;  // of its light in the sample
  float3 diffuse;
  float3 sum;  // what it sends
  Random random;
} LitSurface;

// What it asks of one light.
typedef struct {
  LightPick pick;
  LightSample light;
  float3 from;       // where the shadow ray begins
  float3 scattered;  // of what arrives
  float3 passes;     // what surfaces leave of it
} LightAsked;

// Whether light n is asked for: not where it comes from behind, or lies in the plane of the surface but for what its
// point was rounded by, as neighbours of a solid that emits do along the edge. Of what refracts, highlights are asked
// for where they count.
static inline int light_ask(const Scene* scene, const LitSurface* lit, int n, LightAsked* asked) {
  const Surface* surface = &lit->at;
  asked->pick = light_choose(scene, n, light_choice(lit->random, 0));
  asked->light = light_sample(scene, asked->pick.light, surface->point, lit->random);
  const float3 to_light = -asked->light.travel;
  const float height = fabs(asked->light.distance * dot(surface->geometric_normal, to_light));
  if (!(dot(surface->normal, to_light) > 0.0f) || height <= surface->epsilon) return 0;
  asked->from = surface_leave(surface, to_light);
  asked->scattered = material_reflect(&lit->material, lit->diffuse, surface->normal, to_light, lit->to_viewer);
  return !(lit->material.refraction > 0.0f && vec_max(lit->weight * asked->scattered) < scene->frame->cutoff);
}

#if RAYS_TOGETHER
static inline void shadows_together(const Scene* scene, uint asking, const LitSurface* lit, LightAsked* asked) {
  Way ways[W];
  for (uint left = asking; left != 0; left &= left - 1) {
    const int i = lowest_bit(left);
    const float3 to_light = -asked[i].light.travel;
    ways[i] = way_begin(asked[i].from, to_light, asked[i].light.reach, surface_gap(&lit[i].at, to_light));
  }
  ways_pass(scene, asking, ways);
  for (uint left = asking; left != 0; left &= left - 1) asked[lowest_bit(left)].passes = ways[lowest_bit(left)].left;
}
#endif

// What surfaces leave of the lights that are asked for, those whose bit is set.
static inline void shadows_follow(const Scene* scene, uint asking, const LitSurface* lit, LightAsked* asked) {
#if RAYS_TOGETHER
  if (!BRUME_TRIANGLES || popcount(asking) >= SHADOWS_LEAST) {
    shadows_together(scene, asking, lit, asked);
    return;
  }
#endif
#if BRUME_TRIANGLES || !RAYS_TOGETHER
  for (int i = 0; i < SURFACES; ++i) {
    if (!(asking >> i & 1)) continue;
    const float3 to_light = -asked[i].light.travel;
    asked[i].passes =
        light_passes(scene, asked[i].from, to_light, asked[i].light.reach, surface_gap(&lit[i].at, to_light));
  }
#endif
}

// Adds what it scatters of the light of shadow ray n.
static inline void light_add(const Scene* scene, const LightAsked* asked, int n, LitSurface* lit,
                             SurfaceResult* result) {
  if (!(vec_max(asked->passes) > 0.0f)) return;
  result->lit |= 1u << (asked->pick.light & 31);
  const float3 transmittance =
      media_transmittance(scene, asked->from, -asked->light.travel, asked->light.distance,
                          random_stream(lit->random, STREAM_LIGHT + (uint)n), &result->lookups);
  lit->sum += asked->pick.weight * asked->light.irradiance * asked->passes * transmittance * asked->scattered;
}

// What the surface sends of its own, and the colors of its textures.
static inline void surface_glow(const Scene* scene, LitSurface* lit, SurfaceResult* result) {
  const Material* m = &lit->material;
  uint second;
  lit->diffuse = texture_times(scene, m->diffuse, m->texture, lit->at.uv, &result->second);
  lit->sum = texture_times(scene, m->emission, m->emission_texture, lit->at.uv, &second) +
             vec_unpack(m->ambient) * vec_unpack(scene->frame->ambient);
  result->second |= second;
}

// Adds what the surfaces whose bit is set in `there` scatter of all lights that are asked.
OUTLINED void surfaces_scatter(const Scene* scene, uint there, LitSurface* lit, SurfaceResult* results) {
  LightAsked asked[SURFACES];
  for (int n = 0; n < scene->frame->light_picks; ++n) {
    uint asking = 0;
    for (int i = 0; i < SURFACES; ++i) {
      if (!(there >> i & 1)) continue;
      ++results[i].shadow_rays;
      if (light_ask(scene, lit + i, n, asked + i)) asking |= 1u << i;
    }
    if (asking == 0) continue;
    shadows_follow(scene, asking, lit, asked);
    for (int i = 0; i < SURFACES; ++i)
      if (asking >> i & 1) light_add(scene, asked + i, n, lit + i, results + i);
  }
}

#if BRUME_GOURAUD && BRUME_TRIANGLES
// Of a triangle that blends the light of its corners [Gouraud71], theirs.
static inline void surface_blend(const Scene* scene, const Hit* hit, LitSurface* lit, SurfaceResult* result) {
  float3 geometric, sum = (float3)(0.0f);
  const Triangle triangle = triangle_of(scene, hit->primitive, hit->instance, &geometric);
  for (int k = 0; k < 3; ++k) {
    float share;
    LitSurface corner = *lit;
    corner.at = surface_corner(scene, &triangle, hit, &lit->at, k, &share);
    surfaces_scatter(scene, 1u, &corner, result);
    sum += share * corner.sum;
  }
  lit->sum = sum;
}

static inline int surface_blends(const Scene* scene, const Hit* hit) {
  return hit->primitive >= FIRST_TRIANGLE &&
         scene->triangles[hit->primitive - FIRST_TRIANGLE].shading == TRIANGLE_GOURAUD;
}
#endif

#endif
