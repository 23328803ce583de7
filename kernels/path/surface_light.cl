// What surfaces send towards the rays that hit them: their own light, and what they scatter of the lights that reach
// them. Several of them side by side ask light by light, so that their shadow rays go together.
#ifndef BRUME_PATH_SURFACE_LIGHT_CL
#define BRUME_PATH_SURFACE_LIGHT_CL
#include "lights/lights.cl"
#include "materials/glass.cl"
#include "materials/material.cl"
#include "media/tau.cl"
#include "shapes/together.cl"

#if RAYS_TOGETHER
#define SURFACES (4 * W)       // so that most lanes have a shadow ray
#define SHADOWS_LEAST (W / 4)  // of fewer shadow rays each goes through the triangles alone
#else
#define SURFACES 1
#endif

// A surface that is lit.
typedef struct {
  uint ray;  // its number among those that are worked for, and of its result
  int asks;  // for lights
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
  int surface;
  LightPick pick;
  LightSample light;
  float3 from;       // where the shadow ray begins,
  float gap;         // and how far before the surface
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
  asked->gap = surface_gap(surface, to_light);
  asked->scattered = material_reflect(&lit->material, lit->diffuse, surface->normal, to_light, lit->to_viewer);
  return !(lit->material.refraction > 0.0f && vec_max(lit->weight * asked->scattered) < scene->frame->cutoff);
}

#if RAYS_TOGETHER
// Each lane follows one way after the other: of clear shadows some end sooner.
OUTLINED void shadows_together(const Scene* scene, LightAsked* asked, int count) {
  const int clear = BRUME_CLEAR_SHADOWS && scene->frame->clear_shadows;
  RayLanes rays;
  Way ways[W];
  int name[W], next = 0, open = 0;
  for (int i = 0; i < W; ++i) name[i] = -1;
  do {
    for (int i = 0; i < W; ++i) {
      if (name[i] < 0 && next < count) {
        const LightAsked* its = asked + next;
        name[i] = next++;
        ++open;
        ways[i] = way_begin(its->from, -its->light.travel, its->light.reach, its->gap);
      }
      const Way* way = ways + (name[i] < 0 ? 0 : i);  // lanes without one go along, and look for nothing
      ray_lane_set(&rays, i, way->from, way->dir, name[i] < 0 ? PACKET_DONE : (clear ? way_ahead(way) : way->distance));
    }
    rays_hit(scene, &rays, !clear);
    for (int i = 0; i < W; ++i) {
      if (name[i] < 0) continue;
      const Hit hit = ray_lane_hit(&rays, i);
      if (clear && way_goes_on(scene, &ways[i], &hit)) continue;
      if (!clear && hit.primitive != PRIMITIVE_NONE) ways[i].left = (float3)(0.0f);
      asked[name[i]].passes = ways[i].left;
      name[i] = -1;
      --open;
    }
  } while (open > 0 || next < count);
}
#endif

// What surfaces leave of the lights that are asked for.
static inline void shadows_follow(const Scene* scene, LightAsked* asked, int count) {
#if RAYS_TOGETHER
  if (!BRUME_TRIANGLES || count >= SHADOWS_LEAST) {
    if (count > 0) shadows_together(scene, asked, count);
    return;
  }
#endif
#if BRUME_TRIANGLES || !RAYS_TOGETHER
  for (LightAsked* its = asked; its < asked + count; ++its)
    its->passes = light_passes(scene, its->from, -its->light.travel, its->light.reach, its->gap);
#endif
}

// Adds what it scatters of the light of shadow ray n.
static inline void light_add(const Scene* scene, const LightAsked* asked, int n, LitSurface* lit,
                             __global SurfaceResult* result) {
  if (!(vec_max(asked->passes) > 0.0f)) return;
  result->lit |= 1u << (asked->pick.light & 31);
  uint lookups = 0;
  const float3 transmittance = media_transmittance(scene, asked->from, -asked->light.travel, asked->light.distance,
                                                   random_stream(lit->random, STREAM_LIGHT + (uint)n), &lookups);
  result->lookups += lookups;
  lit->sum += asked->pick.weight * asked->light.irradiance * asked->passes * transmittance * asked->scattered;
}

// What the surface sends of its own, and the colors of its textures.
static inline void surface_glow(const Scene* scene, LitSurface* lit, __global SurfaceResult* result) {
  const Material* m = &lit->material;
  uint first, second;
  lit->diffuse = texture_times(scene, m->diffuse, m->texture, lit->at.uv, &first);
  lit->sum = texture_times(scene, m->emission, m->emission_texture, lit->at.uv, &second) +
             vec_unpack(m->ambient) * vec_unpack(scene->frame->ambient);
  result->second = first | second;
}

// Adds what surfaces scatter of all lights that they ask for.
OUTLINED void surfaces_scatter(const Scene* scene, LitSurface* lit, __global SurfaceResult* results, int count) {
  LightAsked asked[SURFACES];
  for (int n = 0; n < scene->frame->light_picks; ++n) {
    int asking = 0;
    for (int i = 0; i < count; ++i) {
      if (!lit[i].asks) continue;
      ++results[lit[i].ray].shadow_rays;
      asked[asking].surface = i;
      asking += light_ask(scene, lit + i, n, asked + asking);
    }
    shadows_follow(scene, asked, asking);
    for (const LightAsked* its = asked; its < asked + asking; ++its)
      light_add(scene, its, n, lit + its->surface, results + lit[its->surface].ray);
  }
}

#if BRUME_GOURAUD && BRUME_TRIANGLES
// Of a triangle that blends the light of its corners [Gouraud71], theirs.
static inline void surface_blend(const Scene* scene, const Hit* hit, LitSurface* lit, __global SurfaceResult* result) {
  float3 geometric, sum = (float3)(0.0f);
  const Triangle triangle = triangle_of(scene, hit->primitive, hit->instance, &geometric);
  for (int k = 0; k < 3; ++k) {
    float share;
    LitSurface corner = *lit;
    corner.ray = 0;
    corner.asks = 1;
    corner.at = surface_corner(scene, &triangle, hit, &lit->at, k, &share);
    surfaces_scatter(scene, &corner, result, 1);
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
