// Where the samples of a pixel lie and which ray the camera sends through them; random numbers as a pure function.
// Knows nothing of what the ray meets.
#pragma once
#include "reference/vec.hpp"
#include "shared/frame.h"

namespace brume::reference {

// Uniform in [0,1), a multiple of 2⁻²⁴ [Jarzynski20, pcg4d].
double rng_uniform(uint pixel, uint sample, uint dimension, uint seed);

// Position within the pixel, (0,0) its top left corner. Needs 0 <= sample < spp; xi0, xi1 in [0,1) are not read when
// spp is 1.
dvec2 pixel_position(int sample, int spp, double xi0, double xi1);

// The ray of one sample of pixel (x, y), y = 0 at the top, through its point beside the camera's `axis`.
RayD camera_ray(const Camera& camera, int x, int y, const dvec2& position);

// The same from where it enters the bounds of the frame on; `start`: the distance of its origin from the camera.
struct FrameRayD {
  RayD ray;
  double start;
};
FrameRayD frame_ray(const Frame& frame, int x, int y, const dvec2& position);

}  // namespace brume::reference
