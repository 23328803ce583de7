// Two-level DDA [Amanatides87]: bricks, then cells. An iterator that knows geometry only. Crossings are computed afresh as
// (plane - origin) / dir, never accumulated: a thousand float additions drift by a hundred ulp.
#ifndef BRUME_LIB_DDA_CL
#define BRUME_LIB_DDA_CL
#include "lib/medium.cl"

typedef struct {
  float origin, inv_dir;
  int step;                     // -1, 0, 1
  int brick, cell;              // cell in cell space, not brick-local
  float brick_exit, cell_exit;  // s at which the ray leaves them along this axis
} DdaAxis;

typedef struct {
  DdaAxis x, y, z;
  float s;          // all before this is done
  float end;        // end of the ray inside the medium
  float brick_end;  // end of the current stored brick; <= s: find the next one
  int base;         // first voxel of the current brick
  int begun;        // the brick of the entry has been tested
} Dda;

static inline float axis_crossing(const DdaAxis* a, int plane) {
  return a->step == 0 ? INFINITY : ((float)plane - a->origin) * a->inv_dir;
}

static inline void axis_set_brick(DdaAxis* a, int brick) {
  a->brick = brick;
  a->brick_exit = axis_crossing(a, (brick + (a->step > 0)) * BRICK_CELLS);
}

static inline void axis_set_cell(DdaAxis* a, int cell) {
  a->cell = cell;
  a->cell_exit = axis_crossing(a, cell + (a->step > 0));
}

static inline DdaAxis axis_begin(float origin, float dir, int bricks) {
  DdaAxis a;
  a.origin = origin;
  a.step = dir > 0.0f ? 1 : (dir < 0.0f ? -1 : 0);
  a.inv_dir = a.step == 0 ? 0.0f : 1.0f / dir;
  a.cell = 0;
  a.cell_exit = 0.0f;
  axis_set_brick(&a, clamp((int)floor(origin * (1.0f / BRICK_CELLS)), 0, bricks - 1));
  return a;
}

// The cell of the current brick in which the axis stands at s.
static inline void axis_enter_brick(DdaAxis* a, float dir, float s) {
  const int first = a->brick * BRICK_CELLS;
  axis_set_cell(a, clamp((int)floor(mad_exact(s, dir, a->origin)), first, first + BRICK_CELLS - 1));
}

static inline Dda dda_begin(const Medium* medium, const MediumRay* ray) {
  Dda d;
  d.x = axis_begin(ray->origin.x, ray->dir.x, medium->brick_nx);
  d.y = axis_begin(ray->origin.y, ray->dir.y, medium->brick_ny);
  d.z = axis_begin(ray->origin.z, ray->dir.z, medium->brick_nz);
  d.s = 0.0f;
  d.end = ray->length;
  d.brick_end = 0.0f;
  d.base = 0;
  d.begun = 0;
  return d;
}

static inline float dda_exit(const Dda* d, float limit) {
  return fmin(fmin(d->x.brick_exit, d->y.brick_exit), fmin(d->z.brick_exit, limit));
}

// Moves on to the next brick in space; 0 when the ray leaves the grid.
static inline int dda_step_brick(const Medium* medium, Dda* d) {
  if (d->x.brick_exit <= d->y.brick_exit && d->x.brick_exit <= d->z.brick_exit) {
    axis_set_brick(&d->x, d->x.brick + d->x.step);
    return d->x.brick >= 0 && d->x.brick < medium->brick_nx;
  }
  if (d->y.brick_exit <= d->z.brick_exit) {
    axis_set_brick(&d->y, d->y.brick + d->y.step);
    return d->y.brick >= 0 && d->y.brick < medium->brick_ny;
  }
  axis_set_brick(&d->z, d->z.brick + d->z.step);
  return d->z.brick >= 0 && d->z.brick < medium->brick_nz;
}

// Skips to the next brick that is stored and crossed over a positive length: afterwards the ray is in it from s to
// brick_end. 0 when there is none; s is then at the end.
static inline int dda_next_brick(const Medium* medium, __global const int* bricks, Dda* d) {
  int inside = !d->begun || dda_step_brick(medium, d);
  d->begun = 1;
  for (; inside && d->s < d->end; inside = dda_step_brick(medium, d)) {
    const float exit = dda_exit(d, d->end);
    const int entry =
        bricks[medium->brick_offset + (d->z.brick * medium->brick_ny + d->y.brick) * medium->brick_nx + d->x.brick];
    if (entry != BRICK_EMPTY && exit > d->s) {
      d->brick_end = exit;
      d->base = entry * BRICK_VALUES;
      return 1;
    }
    d->s = fmax(d->s, exit);
  }
  d->s = d->end;
  d->brick_end = d->end;
  return 0;
}

#endif
