// What passes hand to each other, one entry per ray of the current batch.
#ifndef BRUME_SHARED_RAY_H
#define BRUME_SHARED_RAY_H
#include "shared/platform.h"

// Reflected and refracted rays that one sample may send on. Up to this depth all of them are no more; deeper ones share
// it out.
#define SECONDARY_RAYS_MAX 4096
#define SECONDARY_DEPTH_WHOLE 11

// How many shapes that refract, one inside the other, a ray remembers to be inside of.
#define INSIDE_MAX 4

BRUME_SHARED_BEGIN
// Samples of one pixel in a batch. No pixel has two entries in it.
typedef struct {
  uint pixel;  // y * width + x of the whole film, y = 0 at the top
  uint first_sample, samples;
  uint first_ray;  // of the batch: all samples of the entries before
} Work;
BRUME_LAYOUT(Work, 16);

// A camera ray, or one that a surface sent on.
typedef struct {
  Packed3 origin;
  uint pixel;   // y * width + x, y = 0 at the top
  Packed3 dir;  // unit, world space
  uint sample;
  Packed3 weight;          // of its light in the sample: 1 for a camera ray
  uint seed;               // of its random numbers
  float heirs;             // how many rays it may send on, those that these send on included
  float start;             // how far before its origin it begins: in the camera, or on the surface that sends it on
  int inside[INSIDE_MAX];  // materials that it is inside of, the last entered first; -1: no more
} Ray;
BRUME_LAYOUT(Ray, 72);

// t: distance to the surface, INFINITY for a miss. u, v: barycentric coordinates of a triangle. Of an isosurface u is
// where it is met, 0 in the grid, on the border of the grid 1 + 2 axis + (1 on the upper side), v is 1 from inside.
// Else 0.
typedef struct {
  float t;
  int primitive;  // shape index, FIRST_TRIANGLE + triangle index, or PRIMITIVE_NONE
  float u, v;
  int instance;  // of whose mesh the triangle is; INSTANCE_NONE: the triangle stands in the world, or it is a shape
  int in_media;  // the way there passes a medium: said by media_met(), 0 before
} Hit;
BRUME_LAYOUT(Hit, 24);

// What the media did to one ray from its origin to the hit.
typedef struct {
  Packed3 transmittance;
  uint lookups;      // density fetches, shadow rays included
  Packed3 radiance;  // in-scattered, as it arrives at the origin
  uint shadow_key;   // which lights surfaces block where: PICTURE, Keys
  uint shadow_rays;
  float error;      // estimate, of the radiance: PICTURE, Estimated errors
  float tau_error;  // of the optical depth
} MediumResult;
BRUME_LAYOUT(MediumResult, 44);

// What a surface sends towards the ray that hit it, and the rays that it sends on.
typedef struct {
  Packed3 radiance;  // its own light and what it scatters of all lights
  uint lit;          // bit l mod 32: light l reaches it
  Packed3 normal;    // shading normal
  uint second;       // 1 in the second part of its texture
  uint lookups;
  uint shadow_rays;
  uint sent;             // rays that it sends on, at most SENT_MAX: entries SENT_MAX * ray on of their buffer
  uint dropped_rays;     // that were not sent on
  float dropped_weight;  // of those: the largest channel of each, added up
} SurfaceResult;
BRUME_LAYOUT(SurfaceResult, 52);
#define SENT_MAX 2  // reflected and refracted

// One sample as it grows, ready to be summed into its pixel after its last ray.
typedef struct {
  Packed3 radiance;
  uint key;               // see PICTURE, Keys
  Packed3 normal;         // of the camera ray's hit: shading normal, 0 for a miss
  float depth;            // from the camera to that hit, 0 for a miss
  Packed3 transmittance;  // of the media before it
  int hit;                // 0 for a miss
  uint first_ray, rays;   // its rays of the wave at work
  uint lookups, shadow_rays, secondary_rays, dropped_rays;
  float dropped_weight;
  float error;  // as in MediumResult, of all its rays
} Sample;
BRUME_LAYOUT(Sample, 80);
BRUME_SHARED_END
#endif
