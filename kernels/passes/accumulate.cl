// Adds the samples of a batch to what their pixels hold, one after another: a picture is bit-identical from run to run
// and for any batch.
#include "lib/vec.cl"
#include "shared/aov.h"
#include "shared/frame.h"
#include "shared/ray.h"
#include "shared/shape.h"

static inline void packed_add(__global Packed3* sum, Packed3 v) {
  sum->x += v.x;
  sum->y += v.y;
  sum->z += v.z;
}

// Squared deviations with one sample x more. With the mean m of the n before, the new mean is m + d / (n + 1), d = x -
// m: their squares grow by n (d / (n + 1))², the sample's own is (n d / (n + 1))², together d² n / (n + 1) [Welford62].
// Σx² - n m² would lose a small variance of a bright pixel to rounding.
static inline Packed3 squares_add(__global const FilmPixel* before, Packed3 radiance) {
  const float n = before->samples;
  if (n == 0.0f) return before->squares;
  const float3 d = vec_unpack(radiance) - vec_unpack(before->radiance) / n;
  return vec_pack(vec_unpack(before->squares) + d * d * (n / (n + 1.0f)));
}

// False where a sample would spoil its pixel: something in it left the range of float.
static inline int sample_valid(__global const Sample* sample) {
  const float3 size = fabs(vec_unpack(sample->radiance));
  return size.x <= SAMPLE_MAX && size.y <= SAMPLE_MAX && size.z <= SAMPLE_MAX &&
         isfinite(sample->normal.x + sample->normal.y + sample->normal.z) &&
         isfinite(sample->transmittance.x + sample->transmittance.y + sample->transmittance.z);
}

OUTLINED void pixel_add(__global FilmPixel* sum, __global const Sample* sample, float unit) {
  sum->shadow_rays += (float)sample->shadow_rays;
  sum->secondary_rays += (float)sample->secondary_rays;
  if (!sample_valid(sample)) {
    sum->invalid += 1.0f;
    return;
  }
  sum->squares = squares_add(sum, sample->radiance);
  packed_add(&sum->radiance, sample->radiance);
  packed_add(&sum->normal, sample->normal);
  packed_add(&sum->transmittance, sample->transmittance);
  sum->samples += 1.0f;
  sum->lookups += (float)sample->lookups;
  sum->dropped_rays += (float)sample->dropped_rays;
  sum->dropped_weight += sample->dropped_weight;
  sum->key += sample->key;
  sum->error += sample->error;
  if (sample->hit) {
    sum->depth += sample->depth * unit;
    sum->hits += 1.0f;
  } else {
    const float3 clear = vec_unpack(sample->transmittance);
    sum->clear += (clear.x + clear.y + clear.z) / 3.0f;
  }
}

// pixels: of each entry of `work`, what its pixel holds. unit: of the scene in world units, a power of two.
__kernel void accumulate(__global const Work* work, uint entries, float unit, __global const Sample* finished,
                         __global FilmPixel* pixels) {
  const uint item = (uint)get_global_id(0);
  if (item >= entries) return;
  const Work entry = work[item];
#pragma unroll 1
  for (uint s = 0; s < entry.samples; ++s) pixel_add(pixels + item, finished + entry.first_ray + s, unit);
}
