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
static inline int sample_valid(const Sample* sample) {
  const float3 size = fabs(vec_unpack(sample->radiance));
  return size.x <= SAMPLE_MAX && size.y <= SAMPLE_MAX && size.z <= SAMPLE_MAX &&
         isfinite(sample->normal.x + sample->normal.y + sample->normal.z) &&
         isfinite(sample->transmittance.x + sample->transmittance.y + sample->transmittance.z);
}

OUTLINED void pixel_add(FilmPixel* sum, const Sample* sample) {
  sum->shadow_rays += (float)sample->shadow_rays;
  sum->secondary_rays += (float)sample->secondary_rays;
  if (!sample_valid(sample)) {
    sum->invalid += 1.0f;
    return;
  }
  packed_add(&sum->radiance, sample->radiance);
  packed_add(&sum->normal, sample->normal);
  packed_add(&sum->transmittance, sample->transmittance);
  sum->samples += 1.0f;
  sum->lookups += (float)sample->lookups;
  sum->dropped_rays += (float)sample->dropped_rays;
  sum->dropped_weight += sample->dropped_weight;
  sum->key += sample->key;
  if (sample->hit) {
    sum->depth += sample->depth;
    sum->hits += 1.0f;
  } else {
    const float3 clear = vec_unpack(sample->transmittance);
    sum->clear += (clear.x + clear.y + clear.z) / 3.0f;
  }
}

__kernel void accumulate(uint first_pixel, uint pixels, uint first_sample, uint samples,
                         __global const Sample* finished, __global FilmPixel* film) {
  const uint pixel = (uint)get_global_id(0);
  if (pixel >= pixels) return;
  FilmPixel sum = pixel_empty();
  if (first_sample > 0) sum = film[first_pixel + pixel];
#pragma unroll 1
  for (uint s = 0; s < samples; ++s) {
    const Sample sample = finished[pixel * samples + s];
    pixel_add(&sum, &sample);
  }
  film[first_pixel + pixel] = sum;
}
