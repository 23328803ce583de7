// Film position of a sample and the ray through it. Definitions: PICTURE, Pixel positions and Camera rays.
#ifndef BRUME_LIB_CAMERA_CL
#define BRUME_LIB_CAMERA_CL
#include "lib/rng.cl"
#include "lib/slab.cl"
#include "lib/sobol.cl"
#include "lib/vec.cl"
#include "shared/frame.h"
#include "shared/ray.h"

// Where sample `sample` of `spp` sits within its pixel: the sequence of the pixel, which does not depend on spp.
static inline float2 pixel_position(uint pixel, uint sample, uint spp, uint seed) {
  if (spp == 1) return (float2)(0.5f, 0.5f);
  return sobol_scrambled(sample, pixel, 0, seed);
}

// t from which the ray is inside the frame's bounds, at least `first`; 0 where it misses them.
static inline float bounds_entry(__constant const Frame* frame, float3 point, float3 dir, float first) {
  float t0 = first, t1 = INFINITY;
  if (!(frame->bounds_lo.x < frame->bounds_hi.x)) return 0.0f;
  return box_cut(vec_unpack(frame->bounds_lo), vec_unpack(frame->bounds_hi), point, dir, &t0, &t1) ? t0 : 0.0f;
}

static inline Ray camera_ray(__constant const Frame* frame, uint pixel, uint sample) {
  __constant const Camera* camera = &frame->camera;
  const float2 in_pixel = pixel_position(pixel, sample, (uint)camera->spp, frame->seed);
  const uint column = pixel % (uint)camera->width;
  const uint row = pixel / (uint)camera->width;
  const float x = 2.0f * ((float)column + in_pixel.x) / (float)camera->width - 1.0f;
  const float y = 1.0f - 2.0f * ((float)row + in_pixel.y) / (float)camera->height;
  const float3 offset = x * vec_unpack(camera->right) + y * vec_unpack(camera->up);
  const int perspective = camera->type == CAMERA_PERSPECTIVE;
  const float3 through = vec_unpack(camera->forward) + (perspective ? offset : (float3)(0.0f));
  const float3 dir = (perspective ? normalize(through) : through) + 0.0f;  // + 0 turns -0.0 into 0.0
  const float3 point = vec_unpack(camera->axis) + (perspective ? camera->back * offset : offset);
  const float behind = camera->back * (perspective ? length(through) : 1.0f);
  const float t = bounds_entry(frame, point, dir, -behind);
  Ray ray;
  ray.origin = vec_pack(vec_point(point, dir, t));
  ray.pixel = pixel;
  ray.dir = vec_pack(dir);
  ray.sample = sample;
  ray.weight = vec_pack((float3)(1.0f));
  ray.seed = frame->seed;
  ray.heirs = frame->max_depth > SECONDARY_DEPTH_WHOLE ? (float)SECONDARY_RAYS_MAX : INFINITY;
  ray.start = behind + t;
  return ray;
}

#endif
