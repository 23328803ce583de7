// What `brume bench --roofline` runs by itself: the rates of the device, and parts of walks without the rest of a pass.
// Compiled with the options of the fog's own kernels.
#include "lib/camera.cl"
#include "media/light_grid.cl"

// One register of numbers an item. Buffers are larger than caches.
__kernel void roofline_copy(__global const float* from, __global float* to) {
  const size_t at = W * get_global_id(0);
  lanes_store(lanes_load(from + at), to + at);
}

// More independent chains than any unit has stages. Unrolled: they are registers then, and not memory.
#define CHAINS 12
__kernel void roofline_fma(uint turns, float factor, __global float* out) {
  floatW sum[CHAINS];
#pragma unroll
  for (int c = 0; c < CHAINS; ++c) sum[c] = lanes_iota() + (floatW)((float)c);
  for (uint i = 0; i < turns; ++i) {
#pragma unroll
    for (int c = 0; c < CHAINS; ++c) sum[c] = mad_exact(sum[c], (floatW)(factor), (floatW)(1.0f));
  }
#pragma unroll
  for (int c = 1; c < CHAINS; ++c) sum[0] += sum[c];
  out[get_global_id(0)] = lanes_sum(sum[0]);
}

// Pairs of neighbours, as lookups take their corners, out of a table that the nearest cache holds: four a turn.
#define TABLE_LAST 1023
#define TABLE_AHEAD 256
__kernel void roofline_loads(uint turns, __global const float* table, __global float* out) {
  uint at = (uint)get_global_id(0);
  float2 sum[4] = {(float2)(0.0f), (float2)(0.0f), (float2)(0.0f), (float2)(0.0f)};
  for (uint i = 0; i < turns; ++i) {
    at = (at + 13) & TABLE_LAST;
#pragma unroll
    for (int k = 0; k < 4; ++k) sum[k] += vload2(0, table + at + k * TABLE_AHEAD);
  }
  const float2 all = sum[0] + sum[1] + sum[2] + sum[3];
  out[get_global_id(0)] = all.x + all.y;
}

// The part of a pixel's camera ray that lies in a medium.
static inline MediumRay camera_ray_inside(__constant const Frame* frame, uint pixel, const Medium* medium) {
  uint pixels[W], samples[W];
  float origin[3][W], dir[3][W];
  for (int i = 0; i < W; ++i) {
    pixels[i] = pixel;
    samples[i] = 0;
  }
  const CameraRays rays = camera_rays(frame, pixels, samples);
  for (int c = 0; c < 3; ++c) {
    lanes_store(rays.origin.v[c], origin[c]);
    lanes_store(rays.dir.v[c], dir[c]);
  }
  return medium_ray(medium, (float3)(origin[0][0], origin[1][0], origin[2][0]),
                    (float3)(dir[0][0], dir[1][0], dir[2][0]), INFINITY);
}

// The cells that the rays of the camera cross, without a look at their densities. out: how many, and a sum of what a
// lookup would read of them.
__kernel void roofline_cells(SCENE_ARGS, uint count, __global float* out) {
  const uint item = (uint)get_global_id(0);
  if (item >= count) return;
  const Scene scene = SCENE_PACK;
  const Medium medium = media[0];
  const MediumRay ray = camera_ray_inside(frame, item, &medium);
  float cells = 0.0f, sum = 0.0f;
  if (ray.length > 0.0f) {
    Walk walk = walk_begin(&scene, &medium, &ray, random_begin(frame, item, 0), WALK_SEEN);
    Segments at;
    for (walk_next(&scene, &medium, &ray, &walk, &at); at.count > 0; walk_next(&scene, &medium, &ray, &walk, &at)) {
      cells += (float)at.count;
      sum += (float)at.base[0] + lanes_sum(lanes_load(at.place) + lanes_load(at.size) + lanes_load(at.x) +
                                           lanes_load(at.y) + lanes_load(at.z));
    }
  }
  out[2 * item] = cells;
  out[2 * item + 1] = sum;
}

// Optical depths to the first light at LOOKUPS places along the rays of the camera. out: how many, and their sum.
#define LOOKUPS 128
__kernel void roofline_light_grid(SCENE_ARGS, uint count, __global float* out) {
  const uint item = (uint)get_global_id(0);
  if (item >= count) return;
  const Scene scene = SCENE_PACK;
  const Medium medium = scene.media[0];
  const MediumRay ray = camera_ray_inside(frame, item, &medium);
  const LightGrid grid = scene.light_grids[medium.light_grids];
  floatW sum = (floatW)(0.0f);
  const int lookups = ray.length > 0.0f ? LOOKUPS : 0;
  for (int i = 0; i < lookups; i += W) {
    const floatW s = (lanes_iota() + (floatW)((float)i + 0.5f)) * (ray.length / LOOKUPS);
    const LightGridPlace at = light_grid_place(&grid, &ray, s);
    sum += light_grid_tau(&grid, scene.light_tau, &at, 0);
  }
  out[2 * item] = (float)lookups;
  out[2 * item + 1] = lanes_sum(sum);
}
