// Two-level DDA [Amanatides87]: bricks, then cells. An iterator that knows geometry only. Crossings are computed afresh
// as (plane - origin) / dir, never accumulated: a thousand float additions drift by a hundred ulp. Stepping has no
// branch on the axis: which one comes next is a coin toss that a processor loses at 15 cycles each.
#ifndef BRUME_DENSITY_DDA_CL
#define BRUME_DENSITY_DDA_CL
#include "density/bricks.cl"

// One axis. Cells and bricks are whole numbers kept as floats: all arithmetic with them is exact below 2^24.
typedef struct {
  float origin, inv_dir;  // of crossings; an axis that does not move crosses at infinity
  float step;             // -1, 0, 1
  float ahead;            // the face that is left: cell + ahead
  float cell, cell_exit;  // cell in cell space, not brick-local, and the s at which the ray leaves it along this axis
  float brick, brick_exit;
} DdaAxis;

typedef struct {
  DdaAxis x, y, z;
  float s;          // all before this is done
  float end;        // end of the ray inside the medium
  float brick_end;  // end of the current stored brick; <= s: find the next one
  int number;       // of the current brick's samples
  int base;         // of the current brick, see Segments
#if BRUME_STORAGE == 2
  float zero, part;  // of the current brick, see Segments
#endif
  int begun;  // the brick of the entry has been tested
} Dda;

static inline float axis_crossing(const DdaAxis* a, float plane) { return (plane - a->origin) * a->inv_dir; }

// At s along a ray of this length. An axis along which it moves by no part of a cell that matters stands still.
static inline DdaAxis axis_begin(float origin, float dir, float s, float length, int bricks) {
  const int moves = fabs(dir) * length > 1e-30f;
  DdaAxis a;
  a.origin = moves ? origin : -1.0f;  // planes are >= 0: the product below is +inf, never 0 * inf
  a.inv_dir = moves ? 1.0f / dir : INFINITY;
  a.step = moves ? (dir > 0.0f ? 1.0f : -1.0f) : 0.0f;
  a.ahead = a.step > 0.0f ? 1.0f : 0.0f;
  a.cell = 0.0f;
  a.cell_exit = 0.0f;
  const float brick = floor(mad_exact(s, dir, origin) * (1.0f / BRICK_CELLS));
  a.brick = fmin_ordered(fmax_ordered(brick, 0.0f), (float)(bricks - 1));
  a.brick_exit = axis_crossing(&a, (a.brick + a.ahead) * BRICK_CELLS);
  return a;
}

// The cell of the current brick in which the axis stands at s; origin is the ray's own.
static inline void axis_enter_brick(DdaAxis* a, float origin, float dir, float s) {
  const float first = a->brick * BRICK_CELLS;
  a->cell = fmin_ordered(fmax_ordered(floor(mad_exact(s, dir, origin)), first), first + (float)(BRICK_CELLS - 1));
  a->cell_exit = axis_crossing(a, a->cell + a->ahead);
}

// Steps the axis over every crossing up to `exit`: one cell or brick, or none.
static inline void axis_step_cell(DdaAxis* a, float exit) {
  a->cell += a->cell_exit <= exit ? a->step : 0.0f;
  a->cell_exit = axis_crossing(a, a->cell + a->ahead);
}

static inline void axis_step_brick(DdaAxis* a, float exit) {
  a->brick += a->brick_exit <= exit ? a->step : 0.0f;
  a->brick_exit = axis_crossing(a, (a->brick + a->ahead) * BRICK_CELLS);
}

static inline Dda dda_begin(const Medium* medium, const MediumRay* ray, float s) {
  Dda d;
  d.x = axis_begin(ray->origin.x, ray->dir.x, s, ray->length, medium->brick_nx);
  d.y = axis_begin(ray->origin.y, ray->dir.y, s, ray->length, medium->brick_ny);
  d.z = axis_begin(ray->origin.z, ray->dir.z, s, ray->length, medium->brick_nz);
  d.s = s;
  d.end = ray->length;
  d.brick_end = 0.0f;
  d.number = 0;
  d.base = 0;
  d.begun = 0;
  return d;
}

static inline float dda_brick_exit(const Dda* d) {
  return fmin_ordered(fmin_ordered(d->x.brick_exit, d->y.brick_exit), d->z.brick_exit);
}
// Where the ray enters the current brick, or 0 where it begins inside.
static inline float axis_brick_enter(const DdaAxis* a) {
  return a->step == 0.0f ? 0.0f : axis_crossing(a, (a->brick + 1.0f - a->ahead) * BRICK_CELLS);
}
static inline float dda_brick_enter(const Dda* d) {
  return fmax(fmax(axis_brick_enter(&d->x), axis_brick_enter(&d->y)), fmax(axis_brick_enter(&d->z), 0.0f));
}
static inline float dda_cell_exit(const Dda* d) {
  return fmin_ordered(fmin_ordered(d->x.cell_exit, d->y.cell_exit), d->z.cell_exit);
}

static inline int axis_inside(const DdaAxis* a, int bricks) { return a->brick >= 0.0f && a->brick < (float)bricks; }

// Moves on to the next brick in space; 0 when the ray leaves the grid. A ray through an edge or a corner takes all its
// crossings at once.
__attribute__((always_inline)) static inline int dda_step_brick(const Medium* medium, Dda* d) {
  const float exit = dda_brick_exit(d);
  axis_step_brick(&d->x, exit);
  axis_step_brick(&d->y, exit);
  axis_step_brick(&d->z, exit);
  return exit < INFINITY && axis_inside(&d->x, medium->brick_nx) && axis_inside(&d->y, medium->brick_ny) &&
         axis_inside(&d->z, medium->brick_nz);
}

// Number of the current brick's samples, or BRICK_EMPTY.
static inline int dda_brick_entry(const Scene* scene, const Medium* medium, const Dda* d) {
  return brick_entry(scene, medium, (int)d->x.brick, (int)d->y.brick, (int)d->z.brick);
}

// Along one axis the bricks in which W places s of a ray lie.
static inline intW lanes_brick(floatW s, float origin, float dir, int bricks) {
  const floatW p = mad_exact(s, (floatW)(dir), (floatW)(origin));
  return lanes_whole(p * (1.0f / BRICK_CELLS), (floatW)((float)(bricks - 1)));
}

// What segment i of a walk takes from the brick in which the walk stands.
static inline void dda_brick_store(const Dda* d, int i, Segments* out) {
  out->base[i] = d->base;
#if BRUME_STORAGE == 2
  out->zero[i] = d->zero;
  out->part[i] = d->part;
#endif
}

// Skips to the next brick that is stored and crossed over a positive length: afterwards the ray is in it from s to
// brick_end. 0 when there is none; s is then at the end.
__attribute__((always_inline)) static inline int dda_next_brick(const Scene* scene, const Medium* medium, Dda* d) {
  while (!d->begun || dda_step_brick(medium, d)) {
    d->begun = 1;
    if (!(d->s < d->end)) break;
    const float leaves = dda_brick_exit(d), exit = fmin_ordered(leaves, d->end);
    const int entry = dda_brick_entry(scene, medium, d);
    if (entry != BRICK_EMPTY && exit > d->s) {
      d->brick_end = exit;
      d->number = entry;
      d->base = brick_base(entry, (int)d->x.brick, (int)d->y.brick, (int)d->z.brick);
#if BRUME_STORAGE == 2
      const float2 scale = brick_scale(scene, entry);
      d->zero = scale.x;
      d->part = scale.y;
#endif
      return 1;
    }
    d->s = fmax_ordered(d->s, exit);
  }
  d->s = d->end;
  d->brick_end = d->end;
  return 0;
}

#endif
