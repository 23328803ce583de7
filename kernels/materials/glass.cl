// What surfaces leave of a light's light on its way to a point: all, nothing, or with render.shadow_of_glass `clear`
// what shapes that refract let through, straight on.
#ifndef BRUME_MATERIALS_GLASS_CL
#define BRUME_MATERIALS_GLASS_CL
#include "materials/inside.cl"

#define GLASS_SURFACES 64  // that are looked for along one way; what is behind more of them does not shine

// A way to a light that is followed straight through everything, and on behind it.
typedef struct {
  float3 origin, dir;
  float distance, gap;  // to the light from `gap` before the origin
  float3 from;          // where what is left of it begins,
  float begin;          // and how far along it that is
  int surfaces;         // that were looked for
  int entered[INSIDE_MAX];
  float nowhere;  // length of it inside of nothing that was entered: it may have begun inside of something
  float at;       // up to where its lengths are counted
  float3 left;    // of the light
} Way;

static inline Way way_begin(float3 origin, float3 dir, float distance, float gap) {
  Way way;
  way.origin = way.from = origin;
  way.dir = dir;
  way.distance = distance;
  way.gap = way.begin = gap;
  way.surfaces = 0;
  inside_begin(way.entered);
  way.nowhere = way.at = 0.0f;
  way.left = (float3)(1.0f);
  return way;
}

// How far the next surface is looked for.
static inline float way_ahead(const Way* way) {
  return way->begin >= way->distance ? INFINITY : way->distance - way->begin;
}

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

// Past what it hits next, or that it hits nothing; 0 at its end. Up to the light surfaces weaken what comes through;
// behind it they only tell what both lie inside of.
OUTLINED int way_goes_on(const Scene* scene, Way* way, const Hit* hit) {
  ++way->surfaces;
  const int behind = way->begin >= way->distance;
  if (hit->primitive == PRIMITIVE_NONE) {
    way_count(scene, way, way->distance);
    if (behind || !(way->nowhere > 0.0f && way->distance < INFINITY)) return 0;
    way->from = vec_point(way->origin, way->dir, way->distance - way->gap);
    way->begin = way->distance;
    return 1;
  }
  Surface surface;
  surface_at(scene, way->from, way->dir, hit, &surface);
  const Material material = scene->materials[surface.material];
  way->begin += hit->t;
  way_count(scene, way, fmin(way->begin, way->distance));
  if (material.refraction > 0.0f && way->surfaces < GLASS_SURFACES) {
    way_cross(scene, way, &surface);
    if (!behind) way->left *= interface_passes(&material, &surface, way->dir);
  } else if (!behind || way->surfaces >= GLASS_SURFACES) {
    way->left = (float3)(0.0f);
  }
  way->from = surface_leave(&surface, way->dir);
  way->begin += surface_gap(&surface, way->dir);
  return vec_max(way->left) > 0.0f;
}

OUTLINED float3 glass_passes(const Scene* scene, float3 origin, float3 dir, float distance, float gap) {
  Way way = way_begin(origin, dir, distance, gap);
  Hit hit;
  do {
    hit = scene_hit(scene, way.from, dir, way_ahead(&way), 0);
  } while (way_goes_on(scene, &way, &hit));
  return way.left;
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
  float3 from = vec_unpack(camera->origin);
  const float3 dir = vec_unpack(camera->dir);
  inside_begin(entered);
  for (int n = 0; n < GLASS_SURFACES && count < INSIDE_MAX; ++n) {
    const Hit hit = scene_hit(scene, from, dir, INFINITY, 0);
    if (hit.primitive == PRIMITIVE_NONE) return;
    Surface surface;
    surface_at(scene, from, dir, &hit, &surface);
    if (scene->materials[surface.material].refraction > 0.0f) {
      if (!surface.leaving)
        inside_enter(entered, surface.material);
      else if (!inside_leave(entered, surface.material))
        camera->inside[count++] = surface.material;
    }
    from = surface_leave(&surface, dir);
  }
}
#endif

#endif
