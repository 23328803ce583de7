// Wave 0: the camera rays of a batch, the samples of each entry of its work side by side. Of every wave: the surfaces
// that its rays hit first.
#include "lib/camera.cl"
#include "materials/glass.cl"
#include "shapes/together.cl"

// The last entry that begins at ray `item` or before. Mostly all entries but the last have as many samples: the first
// guess.
static inline Work work_find(__global const Work* work, uint entries, uint item) {
  const uint even = min(item / work[0].samples, entries - 1);
  const Work guess = work[even];
  if (item - guess.first_ray < guess.samples) return guess;
  uint first = 0;
  for (uint left = entries; left > 1;) {
    const uint half_way = left / 2;
    if (work[first + half_way].first_ray <= item) first += half_way;
    left -= half_way;
  }
  return work[first];
}

// The camera ray of an item of wave 0.
OUTLINED void ray_begin(const Scene* scene, __global const Work* work, uint entries, uint item, __global Ray* ray) {
  const Work entry = work_find(work, entries, item);
  Ray camera = camera_ray(scene->frame, entry.pixel, entry.first_sample + (item - entry.first_ray));
  ray_start_before_planes(scene, &camera);
  inside_begin(camera.inside);
#if BRUME_STARTS_INSIDE && HAS_SURFACES
  if (scene->frame->starts_inside) ray_begin_inside(scene, &camera);
#endif
  *ray = camera;
}

// On a CPU the first of W items follows the rays of all of them, which go about the same way.
#if RAYS_TOGETHER
#define TOGETHER W
OUTLINED void hits_find(const Scene* scene, uint count, __global const Ray* rays, __global Hit* hits) {
  RayLanes lanes;
  for (uint i = 0; i < W; ++i) {
    __global const Ray* ray = rays + min(i, count - 1);
    ray_lane_set(&lanes, (int)i, vec_unpack(ray->origin), vec_unpack(ray->dir), INFINITY);
  }
  rays_hit(scene, &lanes, 0);
  for (uint i = 0; i < min((uint)W, count); ++i) hits[i] = ray_lane_hit(&lanes, (int)i);
}
#else
#define TOGETHER 1
static inline void hits_find(const Scene* scene, uint count, __global const Ray* rays, __global Hit* hits) {
  (void)count;
  *hits = scene_hit(scene, vec_unpack(rays->origin), vec_unpack(rays->dir), INFINITY, 0);
}
#endif

__kernel void primary_rays(SCENE_ARGS, __global const Work* work, uint entries, uint wave, uint count,
                           __global Ray* rays, __global Hit* hits) {
  const uint item = (uint)get_global_id(0);
  if (item >= count || item % TOGETHER != 0) return;
  const Scene scene = SCENE_PACK;
  for (uint i = item; wave == 0 && i < min(item + TOGETHER, count); ++i) ray_begin(&scene, work, entries, i, rays + i);
  hits_find(&scene, count - item, rays + item, hits + item);
}
