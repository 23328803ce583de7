// The isosurface of a grid against W rays at once, by the operations of isosurface_hit: the same bits. Lanes are rays;
// those in bricks that hold iso step from cell to cell together, the others wait and then go from brick to brick. Cells
// that may be crossed are looked into once half of those stand before one.
#ifndef BRUME_SHAPES_ISOSURFACE_TOGETHER_CL
#define BRUME_SHAPES_ISOSURFACE_TOGETHER_CL
#include "shapes/crossings_together.cl"
#include "shapes/forms_together.cl"
#include "shapes/isosurface.cl"

#if W > 1 && BRUME_SHAPES_USED

// DdaAxis of each ray, and the ray along that axis in cell space.
typedef struct {
  floatW ray_origin, ray_dir;
  floatW origin, inv_dir, step, ahead, cell, cell_exit, brick, brick_exit;
} LanesAxis;

// Walks of W rays through the grid.
typedef struct {
  LanesAxis axis[3];
  floatW t_begin, length, end;  // of each in the grid; it is looked for up to `end`
  floatW s;                     // all before this is done
  floatW brick_end;             // of those in cells
  floatW found;                 // s of the first crossing, or CROSSING_NONE
  intW inside;                  // side on which they are
  intW first, number;           // of those in cells: first cell of the brick, its samples
  intW walks, cells, waits;     // which go on; of them from cell to cell; of those before one that may be crossed
} LanesWalk;

#define LANES_FLOOR(x) lanes_to_float(lanes_to_int(x))  // of numbers not below 0

static inline floatW lanes_crossing(const LanesAxis* a, floatW plane) { return (plane - a->origin) * a->inv_dir; }

// medium_ray: the part of each ray inside of the grid.
static inline void walks_begin(const Medium* grid, const RayPacket* rays, LanesWalk* w) {
  const LaneVectors o = lanes_mapped(&grid->cell_from_world, &rays->origin, 1);
  const LaneVectors d = lanes_mapped(&grid->cell_from_world, &rays->dir, 0);
  const float lo[3] = {grid->lo.x, grid->lo.y, grid->lo.z}, hi[3] = {grid->hi.x, grid->hi.y, grid->hi.z};
  floatW t0 = (floatW)(0.0f), t1 = (floatW)(INFINITY);
  const intW inside = lanes_box_cut(vec_unpack(grid->lo), vec_unpack(grid->hi), &o, &d, &t0, &t1);
  w->t_begin = t0;
  w->length = lanes_select((floatW)(0.0f), t1 - t0, inside);
#pragma unroll
  for (int k = 0; k < 3; ++k) {
    const floatW entry = mad_exact(t0, d.v[k], o.v[k]);
    w->axis[k].ray_origin = fmin_ordered(fmax_ordered(entry, (floatW)(lo[k])), (floatW)(hi[k]));
    w->axis[k].ray_dir = d.v[k];
  }
}

// axis_begin at s = 0
static inline void lanes_axis_begin(LanesAxis* a, floatW length, int bricks) {
  const intW moves = fabs(a->ray_dir) * length > 1e-30f;
  const floatW zero = (floatW)(0.0f), one = (floatW)(1.0f);
  a->origin = lanes_select((floatW)(-1.0f), a->ray_origin, moves);
  a->inv_dir = lanes_select((floatW)(INFINITY), 1.0f / a->ray_dir, moves);
  a->step = lanes_select(zero, lanes_select(-one, one, a->ray_dir > 0.0f), moves);
  a->ahead = lanes_select(zero, one, a->step > 0.0f);
  a->cell = a->cell_exit = zero;
  a->brick = fmin_ordered(LANES_FLOOR(a->ray_origin * (1.0f / BRICK_CELLS)), (floatW)((float)(bricks - 1)));
  a->brick_exit = lanes_crossing(a, (a->brick + a->ahead) * BRICK_CELLS);
}

// axis_enter_brick of some
static inline void lanes_enter_brick(LanesAxis* a, floatW s, intW some) {
  const floatW first = a->brick * BRICK_CELLS, at = LANES_FLOOR(mad_exact(s, a->ray_dir, a->ray_origin));
  a->cell = lanes_select(a->cell, fmin_ordered(fmax_ordered(at, first), first + (float)(BRICK_CELLS - 1)), some);
  a->cell_exit = lanes_select(a->cell_exit, lanes_crossing(a, a->cell + a->ahead), some);
}

// dda_step_brick of some
static inline void walks_step_brick(const Medium* grid, LanesWalk* w, intW some) {
  const int bricks[3] = {grid->brick_nx, grid->brick_ny, grid->brick_nz};
  LanesAxis* a = w->axis;
  const floatW exit = fmin_ordered(fmin_ordered(a[0].brick_exit, a[1].brick_exit), a[2].brick_exit);
  intW within = exit < INFINITY;
#pragma unroll
  for (int k = 0; k < 3; ++k) {
    a[k].brick += lanes_select((floatW)(0.0f), a[k].step, some & (a[k].brick_exit <= exit));
    a[k].brick_exit = lanes_crossing(&a[k], (a[k].brick + a[k].ahead) * BRICK_CELLS);
    within &= (a[k].brick >= 0.0f) & (a[k].brick < (float)bricks[k]);
  }
  w->walks &= within | ~some;
}

// Ends the walks of some, with or without a crossing.
static inline void walks_end(LanesWalk* w, intW some) {
  w->walks &= ~some;
  w->cells &= ~some;
}

// Those that are in no cell: into the cells of a brick that holds iso, or on to the next brick.
static inline void walks_brick(const Scene* scene, const Medium* grid, float iso, LanesWalk* w) {
  LanesAxis* a = w->axis;
  walks_end(w, w->walks & ~w->cells & ~(w->s < w->end));
  const intW some = w->walks & ~w->cells;
  const intW x = select((intW)(0), lanes_to_int(a[0].brick), some),
             y = select((intW)(0), lanes_to_int(a[1].brick), some),
             z = select((intW)(0), lanes_to_int(a[2].brick), some);
  const floatW exit =
      fmin_ordered(fmin_ordered(fmin_ordered(a[0].brick_exit, a[1].brick_exit), a[2].brick_exit), w->end);
  const intW crossed = some & (exit > w->s);
  const intW entry = brick_entries(scene, grid, x, y, z), stored = entry != (intW)(BRICK_EMPTY);
  floatW low, high;
  lanes_gather2(scene->ranges, 2 * select((intW)(0), entry, stored), &low, &high);
  const intW below = ~stored | (high <= iso), above = stored & (low > iso), known = crossed & (below | above);
  const intW side = select((intW)(0), (intW)(1), above);
  const intW changes = known & (w->inside != side) & (w->inside != SIDE_UNKNOWN);
  w->inside = select(w->inside, side, known);
  w->found = lanes_select(w->found, w->s, changes);
  walks_end(w, changes);
  w->s = lanes_select(w->s, exit, known & ~changes);
  const intW enter = crossed & ~known;
#pragma unroll
  for (int k = 0; k < 3; ++k) lanes_enter_brick(&a[k], w->s, enter);
  w->brick_end = lanes_select(w->brick_end, exit, enter);
  w->number = select(w->number, entry, enter);
  w->first = select(w->first, BRICK_CELLS * (x + 8 * y + 64 * z), enter);
  w->cells |= enter;
  walks_step_brick(grid, w, some & w->walks & ~enter);
}

// The cells in which the walks of some stand, which they leave at `exit`.
static inline LanesCell walks_load(const Scene* scene, float iso, const LanesWalk* w, floatW exit, intW some) {
  const LanesAxis* a = w->axis;
  const intW number = select((intW)(0), w->number, some);
  const intW at = select((intW)(0), lanes_to_int(a[0].cell), some) & (BRICK_CELLS - 1),
             row = select((intW)(0), lanes_to_int(a[1].cell), some) & (BRICK_CELLS - 1),
             plane = select((intW)(0), lanes_to_int(a[2].cell), some) & (BRICK_CELLS - 1);
  const intW sample = number * BRICK_VALUES + brick_stride(at, row, plane);
  LanesCell c;
  for (int i = 0; i < 4; ++i) {
    floatW left, right;
    voxels_gather2(scene->voxels + brick_stride(0, i & 1, i >> 1), sample, &left, &right);
    c.corner[2 * i] = brick_density(scene, number, left);
    c.corner[2 * i + 1] = brick_density(scene, number, right);
  }
  c.iso = (floatW)(iso);
#pragma unroll
  for (int k = 0; k < 3; ++k) {
    const floatW p = mad_exact(w->s, a[k].ray_dir, a[k].ray_origin) - a[k].cell;
    c.p.v[k] = fmin_ordered(fmax_ordered(p, (floatW)(0.0f)), (floatW)(1.0f));
    c.d.v[k] = a[k].ray_dir * (exit - w->s);
  }
  return c;
}

// Looks into the cells in which the walks wait.
OUTLINED void walks_cross(const Scene* scene, float iso, floatW exit, LanesWalk* w) {
  const LanesCell cells = walks_load(scene, iso, w, exit, w->waits);
  const floatW u = lanes_cross(&cells, w->waits, &w->inside);
  const intW crossed = w->waits & (u >= 0.0f);
  w->found = lanes_select(w->found, mad_exact(u, exit - w->s, w->s), crossed);
  w->waits = (intW)(0);
  walks_end(w, crossed);
}

// One step of those in cells; those before a cell that may be crossed wait for others.
static inline void walks_cell(const Scene* scene, const Medium* grid, float iso, __global const uint* masks,
                              LanesWalk* w) {
  LanesAxis* a = w->axis;
  const floatW exit =
      fmin_ordered(fmin_ordered(a[0].cell_exit, a[1].cell_exit), fmin_ordered(a[2].cell_exit, w->brick_end));
  const intW at = lanes_to_int(a[0].cell + 8.0f * a[1].cell + 64.0f * a[2].cell) - w->first;
  const intW bit = select((intW)(0), at, w->cells), brick = select((intW)(0), w->number, w->cells);
  const intW word = lanes_gather_int((__global const int*)masks, brick * ISO_MASK_WORDS + (bit >> 5));
  const intW maybe = w->cells & (exit > w->s) & ((((word >> (bit & 31)) & 1) != 0) | (w->s == 0.0f));
  intW steps = w->cells & ~maybe;
  w->waits = maybe;
  if (2 * popcount(lanes_bits(maybe)) >= popcount(lanes_bits(w->cells))) {
    walks_cross(scene, iso, exit, w);
    steps = w->cells;
  }
  w->s = lanes_select(w->s, fmax_ordered(w->s, exit), steps);
#pragma unroll
  for (int k = 0; k < 3; ++k) {
    a[k].cell += lanes_select((floatW)(0.0f), a[k].step, steps & (a[k].cell_exit <= exit));
    a[k].cell_exit = lanes_crossing(&a[k], a[k].cell + a[k].ahead);
  }
  const intW leaves = steps & ~(w->s < w->brick_end);
  if (!lanes_any(leaves)) return;
  w->s = lanes_select(w->s, w->brick_end, leaves);
  w->cells &= ~leaves;
  walks_step_brick(grid, w, leaves);
}

// border_at
static inline floatW walks_border(const Medium* grid, const LanesWalk* w, floatW s) {
  const float lo[3] = {grid->lo.x, grid->lo.y, grid->lo.z}, hi[3] = {grid->hi.x, grid->hi.y, grid->hi.z};
  floatW off[3], name[3];
#pragma unroll
  for (int k = 0; k < 3; ++k) {
    const floatW p = mad_exact(s, w->axis[k].ray_dir, w->axis[k].ray_origin);
    const floatW below = fabs(p - lo[k]), above = fabs(hi[k] - p);
    off[k] = fmin_ordered(below, above);
    name[k] = lanes_select((floatW)(1.0f + 2 * k), (floatW)(2.0f + 2 * k), above < below);
  }
  const intW x = (off[0] <= off[1]) & (off[0] <= off[2]), y = off[1] <= off[2];
  return lanes_select(lanes_select(name[2], name[1], y), name[0], x);
}

// isosurface_hit of W rays.
OUTLINED void isosurface_hits(const Scene* scene, const Shape* shape, int index, const RayPacket* rays,
                              PacketHit* hit) {
  const Isosurface surface = isosurface_of(scene, shape);
  const Medium grid = isosurface_grid(&surface);
  const int bricks[3] = {grid.brick_nx, grid.brick_ny, grid.brick_nz};
  LanesWalk w;
  walks_begin(&grid, rays, &w);
  w.walks = (w.length > 0.0f) & (w.t_begin < hit->t);
  if (!lanes_any(w.walks)) return;
#pragma unroll
  for (int k = 0; k < 3; ++k) lanes_axis_begin(&w.axis[k], w.length, bricks[k]);
  w.end = fmin_ordered(w.length, hit->t - w.t_begin);
  w.s = w.brick_end = (floatW)(0.0f);
  w.found = (floatW)(CROSSING_NONE);
  w.inside = select((intW)(SIDE_UNKNOWN), (intW)(0), w.t_begin > 0.0f);
  w.first = w.number = w.cells = w.waits = (intW)(0);
  const intW tried = w.walks;
  while (lanes_any(w.walks)) {
    walks_brick(scene, &grid, surface.iso, &w);
    while (2 * popcount(lanes_bits(w.cells)) > popcount(lanes_bits(w.walks)))
      walks_cell(scene, &grid, surface.iso, scene->iso_masks + surface.masks, &w);
  }
  const intW none = w.found < 0.0f, leaves = none & (w.inside == 1) & (w.end >= w.length);
  const intW border = leaves | (w.found == 0.0f);
  const floatW s = lanes_select(w.found, w.length, leaves), t = w.t_begin + s;
  const intW nearer =
      tried & (leaves | ~none) & (t > 0.0f) & ((t < hit->t) | ((t == hit->t) & (index < hit->primitive)));
  hit->t = lanes_select(hit->t, t, nearer);
  hit->primitive = select(hit->primitive, (intW)(index), nearer);
  hit->u = lanes_select(hit->u, lanes_select((floatW)(0.0f), walks_border(&grid, &w, s), border), nearer);
  hit->v = lanes_select(hit->v, lanes_select((floatW)(1.0f), (floatW)(0.0f), (w.inside != 0) & ~leaves), nearer);
}

#endif
#endif
