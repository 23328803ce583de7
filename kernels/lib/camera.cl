// Film position of a sample and the ray through it. Definitions: PICTURE, Pixel positions and Camera rays.
#ifndef BRUME_LIB_CAMERA_CL
#define BRUME_LIB_CAMERA_CL
#include "lib/rng.cl"
#include "lib/slab.cl"
#include "lib/sobol.cl"
#include "shared/frame.h"

// Where sample `sample` of `spp` sits within its pixel: the sequence of the pixel, which does not depend on spp.
static inline float2 pixel_position(uint pixel, uint sample, uint spp, uint seed) {
  if (spp == 1) return (float2)(0.5f, 0.5f);
  return sobol_scrambled(sample, pixel, 0, seed);
}

// W camera rays side by side, in the world.
typedef struct {
  LaneVectors origin, dir;
  floatW start;  // how far before its origin each begins
} CameraRays;

// t from which each ray is inside the frame's bounds, at least `first`; 0 where it misses them.
static inline floatW bounds_entry(__constant const Frame* frame, const LaneVectors* point, const LaneVectors* dir,
                                  floatW first) {
  floatW t0 = first, t1 = (floatW)(INFINITY);
  if (!(frame->bounds_lo.x < frame->bounds_hi.x)) return (floatW)(0.0f);
  const intW hits = lanes_box_cut(vec_unpack(frame->bounds_lo), vec_unpack(frame->bounds_hi), point, dir, &t0, &t1);
  return lanes_select((floatW)(0.0f), t0, hits);
}

// Film coordinates of these samples.
static inline void film_positions(__constant const Frame* frame, const uint* pixels, const uint* samples, floatW* x,
                                  floatW* y) {
  __constant const Camera* camera = &frame->camera;
  float column[W], row[W];
  for (int i = 0; i < W; ++i) {
    const float2 in_pixel = pixel_position(pixels[i], samples[i], (uint)camera->spp, frame->seed);
    column[i] = (float)(pixels[i] % (uint)camera->width) + in_pixel.x;
    row[i] = (float)(pixels[i] / (uint)camera->width) + in_pixel.y;
  }
  *x = 2.0f * lanes_load(column) / (float)camera->width - 1.0f;
  *y = 1.0f - 2.0f * lanes_load(row) / (float)camera->height;
}

// Of these W samples.
static inline CameraRays camera_rays(__constant const Frame* frame, const uint* pixels, const uint* samples) {
  __constant const Camera* camera = &frame->camera;
  const int perspective = camera->type == CAMERA_PERSPECTIVE;
  const float axis[3] = {camera->axis.x, camera->axis.y, camera->axis.z};
  const float forward[3] = {camera->forward.x, camera->forward.y, camera->forward.z};
  const float right[3] = {camera->right.x, camera->right.y, camera->right.z};
  const float up[3] = {camera->up.x, camera->up.y, camera->up.z};
  floatW x, y, through[3];
  LaneVectors point;
  film_positions(frame, pixels, samples, &x, &y);
  for (int c = 0; c < 3; ++c) {
    const floatW offset = x * right[c] + y * up[c];
    through[c] = perspective ? forward[c] + offset : (floatW)(forward[c]);
    point.v[c] = axis[c] + (perspective ? camera->back * offset : offset);
  }
  floatW length = (floatW)(1.0f);
  if (perspective) length = sqrt(through[0] * through[0] + through[1] * through[1] + through[2] * through[2]);
  CameraRays rays;
  for (int c = 0; c < 3; ++c) rays.dir.v[c] = through[c] / length + 0.0f;  // + 0 turns -0.0 into 0.0
  const floatW behind = camera->back * length, t = bounds_entry(frame, &point, &rays.dir, -behind);
  for (int c = 0; c < 3; ++c) rays.origin.v[c] = mad_exact(t, rays.dir.v[c], point.v[c]);
  rays.start = behind + t;
  return rays;
}

#endif
