// The shadow rays of W surfaces, light by light together: surfaces side by side ask about the same way for a light that
// has no extent. Of one that has each asks another place.
#ifndef BRUME_PATH_SHADOWS_TOGETHER_CL
#define BRUME_PATH_SHADOWS_TOGETHER_CL
#include "path/surface_light.cl"
#include "shapes/together.cl"

#if RAYS_TOGETHER
#define SHADOWS_LEAST (W / 4)  // rays; fewer are followed one by one, when they are asked for

// What is known of pick n by asking for it together; bit i of `there`: surface i is one.
static inline void shadow_ask(const Scene* scene, __global const Ray* rays, uint there, int n, Surface* surfaces) {
  const int all = scene->frame->light_picks == scene->frame->light_count;
  if (all && LIGHT_IS(&scene->lights[n], SURFACE)) return;
  RayLanes lanes;
  uint asking = 0;
  int some = 0;
  for (int i = 0; i < W; ++i) {
    if (!(there >> i & 1)) continue;
    const Ray ray = rays[i];
    const Random random = ray_random(&ray);
    const LightPick pick = light_choose(scene, n, light_choice(random, 0));
    if (LIGHT_IS(&scene->lights[pick.light], SURFACE)) continue;
    LightSample light;
    float3 from;
    if (!shadow_ray(scene, &surfaces[i], pick, random, &light, &from)) continue;
    ray_lane_set(&lanes, i, from, -light.travel, light.reach);
    asking |= 1u << i;
    some = i;
  }
  if (popcount(asking) < SHADOWS_LEAST) return;
  for (int i = 0; i < W; ++i)  // others go along, and look for nothing
    if (!(asking >> i & 1))
      ray_lane_set(&lanes, i, lane_vector(lanes.origin, some), lane_vector(lanes.dir, some), PACKET_DONE);
  rays_hit(scene, &lanes, 1);
  for (int i = 0; i < W; ++i) {
    if (!(asking >> i & 1)) continue;
    surfaces[i].asked |= 1u << n;
    if (lanes.primitive[i] != PRIMITIVE_NONE) surfaces[i].blocked |= 1u << n;
  }
}

// rays: those that hit the surfaces.
static inline void shadows_ask(const Scene* scene, __global const Ray* rays, uint there, Surface* surfaces) {
  if ((BRUME_LIGHTS_USED) == (1 << LIGHT_SURFACE)) return;
  if (scene->frame->clear_shadows || scene->frame->directions > 0) return;
  for (int n = 0; n < min(scene->frame->light_picks, 32); ++n) shadow_ask(scene, rays, there, n, surfaces);
}
#endif

#endif
