// Gradients of the presence of liquids at the samples of their bricks, side by side with the presence itself
// (shared/medium.h). Runs once, before the first batch.
#include "density/bricks.cl"

// Sample s of the grid, beyond which the nearest goes on.
static inline float grid_sample(const Scene* scene, const Medium* m, int x, int y, int z) {
  const int sx = clamp(x, 0, m->cells_x), sy = clamp(y, 0, m->cells_y), sz = clamp(z, 0, m->cells_z);
  const int bx = min(sx / BRICK_CELLS, m->brick_nx - 1), by = min(sy / BRICK_CELLS, m->brick_ny - 1),
            bz = min(sz / BRICK_CELLS, m->brick_nz - 1);
  const int number = brick_entry(scene, m, bx, by, bz);
  if (number == BRICK_EMPTY) return 0.0f;
  const float stored = LOAD_VOXEL(brick_base(number, bx, by, bz) + brick_stride(sx, sy, sz), scene->voxels);
#if BRUME_STORAGE == 2
  const float2 scale = brick_scale(scene, number);
  return scale.x + stored * scale.y;  // rounded as the host does it: one bit more may be another code
#else
  return stored;
#endif
}

#if BRUME_STORAGE == 0
#define GRADIENT_STORE(v, i, p) vstore4(v, i, p)
#elif BRUME_STORAGE == 1
#define GRADIENT_STORE(v, i, p) vstore_half4_rte(v, i, p)
#else
#define GRADIENT_STORE(v, i, p) vstore4(convert_uchar4_sat_rte(v), i, p)
#endif

// Item = row of samples of a brick.
__kernel void presence_gradients(SCENE_ARGS, uint count, __global Voxel* out) {
  const uint item = (uint)get_global_id(0);
  if (item >= count) return;
  const Scene scene = SCENE_PACK;
  const uint brick = item / GRADIENT_ITEMS, row = item % GRADIENT_ITEMS;
  const GradientBrick at = scene.gradient_bricks[brick];
  if (at.medium < 0) return;
  const Medium m = scene.media[at.medium];
  const int number = brick_entry(&scene, &m, at.x, at.y, at.z);
  const int y = BRICK_CELLS * at.y + (int)row % BRICK_SAMPLES, z = BRICK_CELLS * at.z + (int)row / BRICK_SAMPLES;
  for (int i = 0; i < BRICK_SAMPLES; ++i) {
    const int x = BRICK_CELLS * at.x + i;
    const size_t sample = (size_t)row * BRICK_SAMPLES + (size_t)i;
    const float3 d = 0.5f * (float3)(grid_sample(&scene, &m, x + 1, y, z) - grid_sample(&scene, &m, x - 1, y, z),
                                     grid_sample(&scene, &m, x, y + 1, z) - grid_sample(&scene, &m, x, y - 1, z),
                                     grid_sample(&scene, &m, x, y, z + 1) - grid_sample(&scene, &m, x, y, z - 1));
    const float own = LOAD_VOXEL((size_t)number * BRICK_VALUES + sample, scene.voxels);
#if BRUME_STORAGE == 2
    const float4 v = (float4)(d * (float)GRADIENT_PARTS + 128.0f, own);
#else
    const float4 v = (float4)(d, own);
#endif
    GRADIENT_STORE(v, (size_t)brick * BRICK_VALUES + sample, out);
  }
}
