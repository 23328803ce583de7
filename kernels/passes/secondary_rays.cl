// The rays that the hits of a wave sent on become the next wave, side by side in the order of their samples. Item =
// sample.
#include "lib/vec.cl"
#include "shared/ray.h"
#include "shared/shape.h"

// counts: of each sample, how many rays it sends on; first: how many those before it do.
__kernel void secondary_rays(uint count, __global const Hit* hits, __global const SurfaceResult* surfaces,
                             __global const Ray* sent, __global const uint* counts, __global const uint* first,
                             __global Sample* samples, __global Ray* rays) {
  const uint item = (uint)get_global_id(0);
  if (item >= count || counts[item] == 0) return;
  const uint begin = samples[item].first_ray, end = begin + samples[item].rays;
  uint next = first[item];
  for (uint i = begin; i < end; ++i) {
    if (hits[i].primitive == PRIMITIVE_NONE) continue;
    for (uint k = 0; k < surfaces[i].sent; ++k) rays[next++] = sent[(size_t)SENT_MAX * i + k];
  }
  samples[item].first_ray = first[item];
  samples[item].rays = counts[item];
}
