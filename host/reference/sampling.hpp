// Where the samples of a pixel lie and which ray the camera sends through them; random numbers as a pure function.
// Knows nothing of what the ray meets.
#pragma once
#include "reference/vec.hpp"
#include "shared/frame.h"

namespace brume::reference {

// Every 32-bit number equally likely [Jarzynski20, pcg4d].
uint rng_bits(uint pixel, uint sample, uint dimension, uint seed);

// The upper 24 of them: uniform in [0,1), a multiple of 2⁻²⁴.
double rng_uniform(uint pixel, uint sample, uint dimension, uint seed);

// Point `index` of Sobol's sequence in dimension 0 or 1, times 2³² [Sobol67].
uint sobol(uint index, int dimension);
// Point `index` of it, scrambled by rng_bits(pixel, sample, dimension, seed): two numbers in [0, 1).
dvec2 sobol_scrambled(uint index, uint pixel, uint sample, uint seed);

// Position of sample `sample` within its pixel, (0,0) the pixel's top left corner: multiples of 2⁻²⁴ in [0,1), the
// centre where spp is 1 [Burley20] [Vegdahl21]. Depends on spp in nothing else.
dvec2 pixel_position(uint pixel, uint sample, int spp, uint seed);

// The ray of one sample of pixel (x, y), y = 0 at the top, through its point beside the camera's `axis`.
RayD camera_ray(const Camera& camera, int x, int y, const dvec2& position);

// The same from where it enters the bounds of the frame on; `start`: the distance of its origin from the camera.
struct FrameRayD {
  RayD ray;
  double start;
};
FrameRayD frame_ray(const Frame& frame, int x, int y, const dvec2& position);

}  // namespace brume::reference
