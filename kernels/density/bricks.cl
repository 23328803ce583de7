// Where the samples of a brick lie: the only place that reads the index (shared/medium.h).
#ifndef BRUME_DENSITY_BRICKS_CL
#define BRUME_DENSITY_BRICKS_CL
#include "density/medium.cl"

// Where in the index brick (x, y, z) has its block, and within the block its entry; ints or lanes of them.
#define brick_block_at(m, x, y, z)                                                           \
  ((m)->brick_offset +                                                                       \
   (((z) >> BRICK_BLOCK_SHIFT) * brick_blocks((m)->brick_ny) + ((y) >> BRICK_BLOCK_SHIFT)) * \
       brick_blocks((m)->brick_nx) +                                                         \
   ((x) >> BRICK_BLOCK_SHIFT))
#define brick_in_block(x, y, z)                                                                            \
  ((((((z) & (BRICK_BLOCK - 1)) << BRICK_BLOCK_SHIFT) | ((y) & (BRICK_BLOCK - 1))) << BRICK_BLOCK_SHIFT) | \
   ((x) & (BRICK_BLOCK - 1)))
#define brick_blocks(bricks) (((bricks) + BRICK_BLOCK - 1) >> BRICK_BLOCK_SHIFT)

// Number of the samples of a brick of the grid, or BRICK_EMPTY.
static inline int brick_entry(const Scene* scene, const Medium* medium, int x, int y, int z) {
  return scene->bricks[scene->bricks[brick_block_at(medium, x, y, z)] + brick_in_block(x, y, z)];
}

// The same of W bricks, whose blocks' entries begin at `block`.
static inline intW brick_entries_in(const Scene* scene, intW block, intW x, intW y, intW z) {
  return lanes_gather_int(scene->bricks, block + brick_in_block(x, y, z));
}

static inline intW brick_entries(const Scene* scene, const Medium* medium, intW x, intW y, intW z) {
  return brick_entries_in(scene, lanes_gather_int(scene->bricks, brick_block_at(medium, x, y, z)), x, y, z);
}

// The same of W bricks in their order along a ray: where the first and the last lie in one block, all do.
static inline intW brick_entries_along(const Scene* scene, const Medium* medium, intW x, intW y, intW z) {
  const intW at = brick_block_at(medium, x, y, z);
  const intW block =
      lanes_first(at) == lanes_last(at) ? (intW)(scene->bricks[lanes_first(at)]) : lanes_gather_int(scene->bricks, at);
  return brick_entries_in(scene, block, x, y, z);
}

// Where the sample of cell (0, 0, 0) would lie if the brick reached there: cell (x, y, z) is at this +
// brick_stride(x, y, z).
#define brick_base(number, x, y, z) ((number)*BRICK_VALUES - BRICK_CELLS * brick_stride(x, y, z))

#if BRUME_STORAGE == 2
// Of a stored brick: density = x + y * what is stored.
static inline float2 brick_scale(const Scene* scene, int number) {
  const float2 range = vload2(number, scene->ranges);
  return (float2)(range.x, (range.y - range.x) / 255.0f);
}

// The same of W bricks: zero and part.
static inline void brick_scales(const Scene* scene, intW number, float* zero, float* part) {
  int its[W];
  lanes_store(number, its);
  for (int i = 0; i < W; ++i) {
    const float2 scale = brick_scale(scene, its[i]);
    zero[i] = scale.x;
    part[i] = scale.y;
  }
}
#endif

// Density of W values as they are stored in these bricks.
static inline floatW brick_density(const Scene* scene, intW number, floatW stored) {
#if BRUME_STORAGE == 2
  float zero[W], part[W];
  brick_scales(scene, number, zero, part);
  return mad_exact(stored, lanes_load(part), lanes_load(zero));
#else
  (void)scene;
  (void)number;
  return stored;
#endif
}

#endif
