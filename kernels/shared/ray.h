// What passes hand to each other, one entry per ray of the current batch.
#ifndef BRUME_SHARED_RAY_H
#define BRUME_SHARED_RAY_H
#include "shared/platform.h"

// Reflected and refracted rays that one sample may send on. Up to this depth all of them are no more; deeper ones share it out.
#define SECONDARY_RAYS_MAX 4096
#define SECONDARY_DEPTH_WHOLE 11

BRUME_SHARED_BEGIN
typedef struct {
  Packed3 origin;
  uint pixel;   // y * width + x, y = 0 at the top
  Packed3 dir;  // unit, world space
  uint sample;
  float start;  // of a camera ray: distance from the camera to its origin
} Ray;
BRUME_LAYOUT(Ray, 36);

// t: distance to the surface, INFINITY for a miss. u, v: barycentric coordinates of a triangle (else 0).
typedef struct {
  float t;
  int primitive;  // shape index, FIRST_TRIANGLE + triangle index, or PRIMITIVE_NONE
  float u, v;
} Hit;
BRUME_LAYOUT(Hit, 16);

// What a medium did to one ray from its origin to the hit.
typedef struct {
  Packed3 transmittance;
  uint lookups;      // density fetches, shadow rays included
  Packed3 radiance;  // in-scattered, as it arrives at the origin
  uint
      shadow_key;  // counts the samples whose light was blocked by a surface: two renderers agree on it or sit at an edge
  uint shadow_rays;
  uint secondary_rays;
  uint dropped_rays;     // that were not sent on
  float dropped_weight;  // of those: the largest channel of each, added up
} MediumResult;
BRUME_LAYOUT(MediumResult, 48);

// What reaches a surface point from one light: entry [light * rays + ray].
typedef struct {
  Packed3 transmittance;  // of the media; 0 where a surface blocks or N·L <= 0
  uint lit;               // 1 unless blocked or N·L <= 0
} LightArrival;
BRUME_LAYOUT(LightArrival, 16);

// One finished sample, ready to be summed into its pixel.
typedef struct {
  Packed3 radiance;
  uint key;        // see ARCHITECTURE, Keys
  Packed3 normal;  // shading normal, 0 for a miss
  float depth;     // from the camera to the surface, 0 for a miss
} Sample;
BRUME_LAYOUT(Sample, 32);
BRUME_SHARED_END
#endif
