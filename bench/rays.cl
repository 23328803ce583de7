// Rays of a file through the traversal of the passes, for `brume bench`: W at once as `primary_rays` follows them, or
// each alone. in: origin, direction, t_max. out: t, INFINITY for a miss; of `any` 1 where something is hit.
#include "shapes/together.cl"

#define RAYS(name) __kernel void name(SCENE_ARGS, uint count, __global const float* in, __global float* out)

static inline float3 ray_vector(__global const float* p) { return (float3)(p[0], p[1], p[2]); }

OUTLINED void nearest_alone(const Scene* scene, __global const float* ray, __global float* out) {
  const Hit hit = scene_hit(scene, ray_vector(ray), ray_vector(ray + 3), ray[6], 0);
  out[0] = hit.primitive == PRIMITIVE_NONE ? INFINITY : hit.t;
  out[1] = as_float(hit.primitive);
}

RAYS(rays_alone) {
  const uint item = (uint)get_global_id(0);
  const Scene scene = SCENE_PACK;
  if (item < count) nearest_alone(&scene, in + 7 * item, out + 2 * item);
}

#if W > 1
static inline void lanes_hit(const Scene* scene, __global const float* in, int any, RayLanes* rays) {
  for (uint i = 0; i < W; ++i) {
    __global const float* ray = in + 7 * i;
    ray_lane_set(rays, i, ray_vector(ray), ray_vector(ray + 3), ray[6]);
  }
  rays_hit(scene, rays, any);
}
#endif

OUTLINED void nearest_together(const Scene* scene, __global const float* in, __global float* out) {
#if W > 1
  RayLanes rays;
  lanes_hit(scene, in, 0, &rays);
  for (uint i = 0; i < W; ++i) {
    out[2 * i] = rays.primitive[i] == PRIMITIVE_NONE ? INFINITY : rays.t[i];
    out[2 * i + 1] = as_float(rays.primitive[i]);
  }
#else
  nearest_alone(scene, in, out);
#endif
}

// A multiple of W.
RAYS(rays_together) {
  const uint item = (uint)get_global_id(0);
  const Scene scene = SCENE_PACK;
  if (item < count && item % W == 0) nearest_together(&scene, in + 7 * item, out + 2 * item);
}

OUTLINED void any_alone(const Scene* scene, __global const float* ray, __global float* out) {
  out[0] = (float)scene_occluded(scene, ray_vector(ray), ray_vector(ray + 3), ray[6]);
  out[1] = 0.0f;
}

RAYS(rays_occluded) {
  const uint item = (uint)get_global_id(0);
  const Scene scene = SCENE_PACK;
  if (item < count) any_alone(&scene, in + 7 * item, out + 2 * item);
}

OUTLINED void any_together(const Scene* scene, __global const float* in, __global float* out) {
#if W > 1
  RayLanes rays;
  lanes_hit(scene, in, 1, &rays);
  for (uint i = 0; i < W; ++i) out[2 * i] = (float)(rays.primitive[i] != PRIMITIVE_NONE);
#else
  any_alone(scene, in, out);
#endif
}

RAYS(rays_occluded_together) {
  const uint item = (uint)get_global_id(0);
  const Scene scene = SCENE_PACK;
  if (item < count && item % W == 0) any_together(&scene, in + 7 * item, out + 2 * item);
}
