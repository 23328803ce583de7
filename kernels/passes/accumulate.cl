// Adds the samples of a batch to their pixels, in a fixed order: a picture is bit-identical from run to run.
#include "lib/vec.cl"
#include "shared/aov.h"
#include "shared/frame.h"
#include "shared/ray.h"
#include "shared/shape.h"

static inline void packed_add(Packed3* sum, Packed3 v) {
  sum->x += v.x;
  sum->y += v.y;
  sum->z += v.z;
}

static inline FilmPixel pixel_empty(void) {
  FilmPixel p;
  p.radiance = p.normal = p.transmittance = vec_pack((float3)(0.0f));
  p.dropped_rays = p.dropped_weight = 0.0f;
  p.samples = p.depth = p.hits = p.lookups = p.shadow_rays = p.secondary_rays = p.invalid = p.clear = 0.0f;
  p.key = 0;
  return p;
}

// False where a sample would spoil its pixel: something in it left the range of float.
static inline int sample_valid(const Sample* sample, Packed3 transmittance) {
  const float3 size = fabs(vec_unpack(sample->radiance));
  return size.x <= SAMPLE_MAX && size.y <= SAMPLE_MAX && size.z <= SAMPLE_MAX &&
         isfinite(sample->normal.x + sample->normal.y + sample->normal.z) &&
         isfinite(transmittance.x + transmittance.y + transmittance.z);
}

__kernel void accumulate(uint first_pixel, uint pixels, uint first_sample, uint samples, __global const Hit* hits,
                         __global const MediumResult* results, __global const Sample* finished,
                         __global FilmPixel* film) {
  const uint pixel = (uint)get_global_id(0);
  if (pixel >= pixels) return;
  FilmPixel sum = pixel_empty();
  if (first_sample > 0) sum = film[first_pixel + pixel];
  for (uint s = 0; s < samples; ++s) {
    const uint item = pixel * samples + s;
    const Sample sample = finished[item];
    sum.shadow_rays += (float)results[item].shadow_rays;
    sum.secondary_rays += (float)results[item].secondary_rays;
    if (!sample_valid(&sample, results[item].transmittance)) {
      sum.invalid += 1.0f;
      continue;
    }
    packed_add(&sum.radiance, sample.radiance);
    packed_add(&sum.normal, sample.normal);
    packed_add(&sum.transmittance, results[item].transmittance);
    sum.samples += 1.0f;
    sum.lookups += (float)results[item].lookups;
    sum.dropped_rays += (float)results[item].dropped_rays;
    sum.dropped_weight += results[item].dropped_weight;
    sum.key += sample.key;
    if (hits[item].primitive != PRIMITIVE_NONE) {
      sum.depth += sample.depth;
      sum.hits += 1.0f;
    } else {
      const float3 clear = vec_unpack(results[item].transmittance);
      sum.clear += (clear.x + clear.y + clear.z) / 3.0f;
    }
  }
  film[first_pixel + pixel] = sum;
}
