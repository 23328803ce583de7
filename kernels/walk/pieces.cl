// Placement and rule of `adaptive`: each brick is cut into as many equal pieces, of two points each, as the plan finds
// that it needs, or at the faces of its cells where it is rough (PICTURE, Pieces).
#ifndef BRUME_WALK_PIECES_CL
#define BRUME_WALK_PIECES_CL
#include "walk/cells.cl"

#define PIECE_SLACK 0.75f  // of a piece: a way through a corner of a brick is not worth one more

typedef struct {
  int next, count;    // of the current brick; none of both where it is walked by cells
  float begin, size;  // of its pieces
  float until;        // s behind which nobody asks
  float cells;        // along the ray, per length
  int to_light;       // rays to lights are walked by rates of their own
} Pieces;

static inline Pieces pieces_begin(const MediumRay* ray, float until, int to_light) {
  Pieces p = {0, 0, 0.0f, 0.0f, until, length(ray->dir), to_light};
  return p;
}

// Of a brick: the rates of view rays and of rays to lights, and what its pieces err by.
static inline float piece_row(const Scene* scene, const Medium* medium, int brick, int entry) {
  return scene->piece_rates[medium->piece_rates + PIECE_ROW * brick + entry];
}

static inline int pieces_next_brick(const Scene* scene, const Medium* medium, const MediumRay* ray, Dda* d, Pieces* p) {
  if (!(d->s < p->until) || !dda_next_brick(scene, medium, d)) return 0;
  const float rate = piece_row(scene, medium, d->number, p->to_light);
  p->next = p->count = 0;
  if (rate < PIECE_RATE_CELLS) {
    const float way = d->brick_end - d->s;
    p->count = max(1, (int)ceil(rate * p->cells * way - PIECE_SLACK));
    p->begin = d->s;
    p->size = p->count == 1 ? way : way / (float)p->count;
  } else {
    axis_enter_brick(&d->x, ray->origin.x, ray->dir.x, d->s);
    axis_enter_brick(&d->y, ray->origin.y, ray->dir.y, d->s);
    axis_enter_brick(&d->z, ray->origin.z, ray->dir.z, d->s);
  }
  return 1;
}

// What the segments of one brick have in common, from lane n on; later bricks overwrite theirs.
typedef struct {
  intW base;
  floatW x, y, z;
#if BRUME_STORAGE == 2
  floatW zero, part;
#endif
} PieceBricks;

static inline void piece_bricks_set(const Dda* d, int n, PieceBricks* b) {
  const intW from_n = lanes_iota() >= (floatW)((float)n);
  b->base = lanes_select(b->base, (intW)(d->base), from_n);
  b->x = lanes_select(b->x, (floatW)(d->x.brick * BRICK_CELLS), from_n);
  b->y = lanes_select(b->y, (floatW)(d->y.brick * BRICK_CELLS), from_n);
  b->z = lanes_select(b->z, (floatW)(d->z.brick * BRICK_CELLS), from_n);
#if BRUME_STORAGE == 2
  b->zero = lanes_select(b->zero, (floatW)(d->zero), from_n);
  b->part = lanes_select(b->part, (floatW)(d->part), from_n);
#endif
}

static inline void piece_put(const Dda* d, float begin, float size, uint number, int n, Segments* out) {
  out->begin[n] = begin;
  out->size[n] = size;
#if BRUME_RANDOM
  out->id[n] = ((uint)(int)(d->x.brick * BRICK_CELLS) * 0x8DA6B343u) ^
               ((uint)(int)(d->y.brick * BRICK_CELLS) * 0xD8163841u) ^
               ((uint)(int)(d->z.brick * BRICK_CELLS) * 0xCB1AB31Fu) ^ (number * 0x85EBCA6Bu);
#else
  (void)d;
  (void)number;
#endif
}

// Cells of the current brick, from segment n on; returns how many there are then.
static inline int pieces_cells(Dda* d, int n, Segments* out) {
  const float end = d->brick_end;
  do {
    const float exit = fmin_ordered(dda_cell_exit(d), end);
    const float x = d->x.cell - d->x.brick * BRICK_CELLS, y = d->y.cell - d->y.brick * BRICK_CELLS;
    const float z = d->z.cell - d->z.brick * BRICK_CELLS;
    piece_put(d, d->s, exit - d->s, (uint)(int)brick_stride(x, y, z), n, out);
    n += exit > d->s;
    d->s = exit > d->s ? exit : d->s;
    axis_step_cell(&d->x, exit);
    axis_step_cell(&d->y, exit);
    axis_step_cell(&d->z, exit);
  } while (n < W && d->s < end);
  return n;
}

static inline void pieces_fill(const Scene* scene, const Medium* medium, const MediumRay* ray, Dda* dda, Pieces* pieces,
                               Segments* out) {
  Dda d = *dda;
  Pieces p = *pieces;
  PieceBricks bricks = {(intW)(0), (floatW)(0.0f), (floatW)(0.0f), (floatW)(0.0f)};
  int n = 0;
  while (n < W && (d.s < d.brick_end || pieces_next_brick(scene, medium, ray, &d, &p))) {
    piece_bricks_set(&d, n, &bricks);
    if (p.count == 0) {
      n = pieces_cells(&d, n, out);
      continue;
    }
    for (; n < W && p.next < p.count; ++n, ++p.next)
      piece_put(&d, mad_exact((float)p.next, p.size, p.begin), p.size, (uint)p.next, n, out);
    if (p.next == p.count) d.s = d.brick_end;
  }
  *dda = d;
  *pieces = p;
  out->count = n;
  const intW counts = lanes_iota() < (floatW)((float)n);
  const floatW begin = lanes_select((floatW)(0.0f), lanes_load(out->begin), counts);
  const floatW size = lanes_select((floatW)(0.0f), lanes_load(out->size), counts);
  lanes_store(begin, out->begin);
  lanes_store(size, out->size);
  lanes_store(mad_exact((floatW)(0.5f), size, begin), out->place);
  lanes_store(bricks.base, out->base);
  lanes_store(bricks.x, out->x);
  lanes_store(bricks.y, out->y);
  lanes_store(bricks.z, out->z);
#if BRUME_STORAGE == 2
  lanes_store(bricks.zero, out->zero);
  lanes_store(bricks.part, out->part);
#endif
#if BRUME_RANDOM
  for (int i = n; i < W; ++i) out->id[i] = 0;
#endif
#if BRUME_TRACKING
  lanes_store((floatW)(0.0f), out->low);
  lanes_store((floatW)(0.0f), out->control);
#endif
}

static inline floatW piece_density(const Medium* medium, __global const Voxel* voxels, const MediumRay* ray,
                                   const Segments* at, floatW s) {
  const Lookup l = lookup_at(ray, at, s, WITHIN_BRICK);
  return density_of(at, lookup_value(medium, voxels, &l));
}

// Also the share of ∫ρ that the second point stands for.
static inline floatW piece_shares(const Medium* medium, __global const Voxel* voxels, const MediumRay* ray,
                                  const Segments* at, floatW* second) {
  const floatW middle = lanes_load(at->place), size = lanes_load(at->size);
  const floatW away = size * 0.288675134594813f;  // 1 / (2 √3)
  const floatW before = piece_density(medium, voxels, ray, at, middle - away),
               after = piece_density(medium, voxels, ray, at, middle + away), sum = before + after;
  *second = lanes_select((floatW)(0.5f), after / sum, sum > 0.0f);
  return 0.5f * size * sum;
}

static inline floatW piece_integral(const Medium* medium, __global const Voxel* voxels, const MediumRay* ray,
                                    const Segments* at) {
  floatW second;
  return piece_shares(medium, voxels, ray, at, &second);
}

#endif
