// What surfaces leave of a light's light on its way to a point: all, nothing, or with render.shadow_of_glass `clear`
// what shapes that refract let through, straight on.
#ifndef BRUME_MATERIALS_GLASS_CL
#define BRUME_MATERIALS_GLASS_CL
#include "materials/inside.cl"

#define GLASS_SURFACES 64  // that are looked for along one way; what is behind more of them does not shine

// A way that is followed straight through everything from its begin.
typedef struct {
  int entered[INSIDE_MAX];
  float nowhere;  // length of it inside of nothing that was entered: it may have begun inside of something
  float at;       // up to where its lengths are counted
  float3 left;    // of the light
} Way;

static inline void way_count(const Scene* scene, Way* way, float to) {
  if (!(to > way->at)) return;
  if (way->entered[0] < 0) way->nowhere += to - way->at;
  way->left *= inside_transmittance(scene, way->entered, to - way->at);
  way->at = to;
}

// What it leaves without having entered it, it began inside of.
static inline void way_cross(const Scene* scene, Way* way, const Surface* surface) {
  if (!surface->leaving) {
    inside_enter(way->entered, surface->material);
  } else if (!inside_leave(way->entered, surface->material)) {
    way->left *= absorption_transmittance(scene, surface->material, way->nowhere);
    way->nowhere = 0.0f;
  }
}

// Share of light that comes through an interface, at the angle on its outer side, on which lights mostly are.
static inline float interface_passes(const Material* material, const Surface* surface, float3 dir) {
  if (!material->fresnel) return material->refraction;
  return material->refraction * (1.0f - fresnel_reflectance(fabs(dot(surface->normal, dir)), 1.0f / material->ior));
}

// Up to the light surfaces weaken what comes through; behind it they only tell what both lie inside of.
OUTLINED float3 glass_passes(const Scene* scene, float3 origin, float3 dir, float distance, float gap) {
  Way way;
  inside_begin(way.entered);
  way.nowhere = way.at = 0.0f;
  way.left = (float3)(1.0f);
  Ray ray;
  ray.origin = vec_pack(origin);
  ray.dir = vec_pack(dir);
  float begin = gap;  // of the ray, along the way
  for (int n = 0; n < GLASS_SURFACES; ++n) {
    const int behind = begin >= distance;
    const Hit hit = scene_hit(scene, vec_unpack(ray.origin), dir, behind ? INFINITY : distance - begin, 0);
    if (hit.primitive == PRIMITIVE_NONE) {
      way_count(scene, &way, distance);
      if (behind || !(way.nowhere > 0.0f && distance < INFINITY)) return way.left;
      ray.origin = vec_pack(vec_point(origin, dir, distance - gap));
      begin = distance;
      continue;
    }
    const Surface surface = surface_at(scene, &ray, &hit);
    const Material material = scene->materials[surface.material];
    begin += hit.t;
    way_count(scene, &way, fmin(begin, distance));
    if (material.refraction > 0.0f) {
      way_cross(scene, &way, &surface);
      if (!behind) way.left *= interface_passes(&material, &surface, dir);
    } else if (!behind) {
      return (float3)(0.0f);
    }
    if (!(vec_max(way.left) > 0.0f)) return (float3)(0.0f);
    ray.origin = vec_pack(surface_leave(&surface, dir));
    begin += surface_gap(&surface, dir);
  }
  return (float3)(0.0f);
}

// V: what surfaces leave of the light that comes over `distance` along -dir to a point; origin lies `gap` before it.
static inline float3 light_passes(const Scene* scene, float3 origin, float3 dir, float distance, float gap) {
#if BRUME_CLEAR_SHADOWS
  if (scene->frame->clear_shadows) return glass_passes(scene, origin, dir, distance, gap);
#endif
  return scene_occluded(scene, origin, dir, distance) ? (float3)(0.0f) : (float3)(1.0f);
}

#if BRUME_STARTS_INSIDE
// What a camera ray begins inside of: what it leaves, straight on, without having entered it.
OUTLINED void ray_begin_inside(const Scene* scene, Ray* camera) {
  int entered[INSIDE_MAX], count = 0;
  Ray ray = *camera;
  const float3 dir = vec_unpack(ray.dir);
  inside_begin(entered);
  for (int n = 0; n < GLASS_SURFACES && count < INSIDE_MAX; ++n) {
    const Hit hit = scene_hit(scene, vec_unpack(ray.origin), dir, INFINITY, 0);
    if (hit.primitive == PRIMITIVE_NONE) return;
    const Surface surface = surface_at(scene, &ray, &hit);
    if (scene->materials[surface.material].refraction > 0.0f) {
      if (!surface.leaving)
        inside_enter(entered, surface.material);
      else if (!inside_leave(entered, surface.material))
        camera->inside[count++] = surface.material;
    }
    ray.origin = vec_pack(surface_leave(&surface, dir));
  }
}
#endif

#endif
