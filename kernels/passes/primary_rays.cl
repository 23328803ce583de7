// Wave 0: the camera rays of a batch, the samples of each entry of its work side by side. Of every wave: the surfaces
// that its rays hit first, and whether media lie before them.
#include "lib/camera.cl"
#include "materials/glass.cl"
#include "media/met.cl"
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

// The camera rays of the items from `item` on, at most W of them.
OUTLINED void rays_begin(const Scene* scene, __global const Work* work, uint entries, uint item, int count,
                         __global Ray* rays) {
  __constant const Frame* frame = scene->frame;
  uint pixels[W], samples[W];
  for (int i = 0; i < W; ++i) {
    const uint its = item + (uint)min(i, count - 1);
    const Work entry = work_find(work, entries, its);
    pixels[i] = entry.pixel;
    samples[i] = entry.first_sample + (its - entry.first_ray);
  }
  const CameraRays all = camera_rays(frame, pixels, samples);
  float origin[3][W], dir[3][W], start[W];
  for (int c = 0; c < 3; ++c) {
    lanes_store(all.origin.v[c], origin[c]);
    lanes_store(all.dir.v[c], dir[c]);
  }
  lanes_store(all.start, start);
  for (int i = 0; i < count; ++i) {
    Ray ray;
    ray.origin = vec_pack((float3)(origin[0][i], origin[1][i], origin[2][i]));
    ray.pixel = pixels[i];
    ray.dir = vec_pack((float3)(dir[0][i], dir[1][i], dir[2][i]));
    ray.sample = samples[i];
    ray.weight = vec_pack((float3)(1.0f));
    ray.seed = frame->seed;
    ray.heirs = frame->max_depth > SECONDARY_DEPTH_WHOLE ? (float)SECONDARY_RAYS_MAX : INFINITY;
    ray.start = start[i];
    ray_start_before_planes(scene, &ray);
    inside_begin(ray.inside);
#if BRUME_STARTS_INSIDE && HAS_SURFACES
    if (frame->starts_inside) ray_begin_inside(scene, &ray);
#endif
    rays[i] = ray;
  }
}

// On a CPU the first of W items follows the rays of all of them, which go about the same way.
OUTLINED void hits_find(const Scene* scene, int count, __global const Ray* rays, __global Hit* hits) {
#if RAYS_TOGETHER
  RayLanes lanes;
  for (int i = 0; i < W; ++i) {
    __global const Ray* ray = rays + min(i, count - 1);
    ray_lane_set(&lanes, i, vec_unpack(ray->origin), vec_unpack(ray->dir), INFINITY);
  }
  rays_hit(scene, &lanes, 0);
  for (int i = 0; i < count; ++i) hits[i] = ray_lane_hit(&lanes, i);
#else
  for (int i = 0; i < count; ++i)
    hits[i] = scene_hit(scene, vec_unpack(rays[i].origin), vec_unpack(rays[i].dir), INFINITY, 0);
#endif
}

__kernel void primary_rays(SCENE_ARGS, __global const Work* work, uint entries, uint wave, uint count,
                           __global Ray* rays, __global Hit* hits) {
  const uint item = (uint)get_global_id(0);
  if (item >= count || item % W != 0) return;
  const Scene scene = SCENE_PACK;
  const int left = (int)min((uint)W, count - item);
  if (wave == 0) rays_begin(&scene, work, entries, item, left, rays + item);
  hits_find(&scene, left, rays + item, hits + item);
  media_met(&scene, left, rays + item, hits + item);
}
