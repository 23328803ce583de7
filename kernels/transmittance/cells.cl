// Placement of the DDA methods: segments between the crossings of cell faces, empty bricks skipped.
#ifndef BRUME_TRANSMITTANCE_CELLS_CL
#define BRUME_TRANSMITTANCE_CELLS_CL
#include "lib/dda.cl"

static inline void cells_step(Dda* d, float exit) {
  if (exit == d->x.cell_exit) {
    axis_set_cell(&d->x, d->x.cell + d->x.step);
  } else if (exit == d->y.cell_exit) {
    axis_set_cell(&d->y, d->y.cell + d->y.step);
  } else {
    axis_set_cell(&d->z, d->z.cell + d->z.step);
  }
}

static inline void cells_fill(const Medium* medium, __global const int* bricks, const MediumRay* ray, Dda* d,
                              Segments* out) {
  out->count = 0;
  while (out->count < W) {
    if (!(d->s < d->brick_end)) {
      if (!dda_next_brick(medium, bricks, d)) break;
      axis_enter_brick(&d->x, ray->dir.x, d->s);
      axis_enter_brick(&d->y, ray->dir.y, d->s);
      axis_enter_brick(&d->z, ray->dir.z, d->s);
    }
    const float cell_exit = fmin(d->x.cell_exit, fmin(d->y.cell_exit, d->z.cell_exit));
    const float exit = fmin(cell_exit, d->brick_end);
    if (exit > d->s) {
      segment_push(out, 0.5f * (d->s + exit), exit - d->s, d->base, d->x.brick, d->y.brick, d->z.brick);
      d->s = exit;
    }
    if (cell_exit < d->brick_end) {
      cells_step(d, cell_exit);
    } else {
      d->s = d->brick_end;
    }
  }
}

#endif
