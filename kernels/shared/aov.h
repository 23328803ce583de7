// Named planes of the film beside the radiance.
#ifndef BRUME_SHARED_AOV_H
#define BRUME_SHARED_AOV_H
#include "shared/platform.h"

// ROW(ID, name, channels, help)
#define BRUME_AOVS(ROW)                                                                                            \
  ROW(DEPTH, "depth", 1, "distance to the first surface, mean over the samples that hit one; inf where none does") \
  ROW(NORMAL, "normal", 3, "unit shading normal of the first surface in world space; 0 where there is none")       \
  ROW(TRANSMITTANCE, "transmittance", 3, "of all media between the camera and the first surface")                  \
  ROW(COST, "cost", 1, "density lookups per sample, shadow rays included")                                         \
  ROW(VARIANCE, "variance", 3,                                                                                     \
      "of one sample, unbiased; divided by `samples` the squared standard error of the pixel; 0 below 2 samples")  \
  ROW(SAMPLES, "samples", 1, "how many samples the pixel is the mean of")                                          \
  ROW(ERROR, "error", 1, "estimate: what adaptive expects of its walk, and the standard error of several samples")

BRUME_SHARED_BEGIN
enum Aov {
#define ROW(id, name, channels, help) AOV_##id,
  BRUME_AOVS(ROW)
#undef ROW
      AOV_COUNT
};

// Radiance beyond which a sample is left out: 2^20 samples of it, the most that a pixel can have, still make a finite
// sum.
#define SAMPLE_MAX 3e32f

// Sums over a pixel's samples; the host divides by the counts. `key` sums a hash of what each sample hit and which
// lights reached it (wrapping): equal keys mean that two renderers saw the same surfaces and shadows.
typedef struct {
  Packed3 radiance;
  float samples;    // in the sums
  Packed3 squares;  // of each channel the sum of (sample's radiance - mean of the samples)²; inf beyond float
  Packed3 normal;
  float depth;  // in world units, sum over the samples that hit
  Packed3 transmittance;
  float hits;  // samples that hit a surface
  float lookups;
  uint key;
  float shadow_rays;
  float secondary_rays;
  float dropped_rays;  // as in SurfaceResult
  float dropped_weight;
  // Samples left out of all sums above but the counts of rays: their radiance was no number or above SAMPLE_MAX.
  float invalid;
  // Transmittance, its three channels' mean, over the samples that hit nothing: how much of the background is seen.
  float clear;
  float error;  // what `adaptive` expects to be off by
} FilmPixel;
BRUME_LAYOUT(FilmPixel, 96);
BRUME_SHARED_END
#endif
