// Placement of the DDA methods: segments between the crossings of cell faces, empty bricks skipped.
#ifndef BRUME_TRANSMITTANCE_CELLS_CL
#define BRUME_TRANSMITTANCE_CELLS_CL
#include "lib/dda.cl"

static inline int cells_next_brick(const Scene* scene, const Medium* medium, const MediumRay* ray, Dda* d) {
  if (!dda_next_brick(scene, medium, d)) return 0;
  axis_enter_brick(&d->x, ray->origin.x, ray->dir.x, d->s);
  axis_enter_brick(&d->y, ray->origin.y, ray->dir.y, d->s);
  axis_enter_brick(&d->z, ray->origin.z, ray->dir.z, d->s);
  return 1;
}

// Every turn of the loop moves s or steps an axis. What has no length is overwritten by the next segment. The axes are copied:
// behind a pointer the compiler must take the segments' stores for changes of them, and each step would wait for memory.
static inline void cells_fill(const Scene* scene, const Medium* medium, const MediumRay* ray, Dda* d, Segments* out) {
  int n = 0;
  while (n < W && (d->s < d->brick_end || cells_next_brick(scene, medium, ray, d))) {
    DdaAxis x = d->x, y = d->y, z = d->z;
    const float end = d->brick_end;
    float s = d->s;
    do {
      const float exit = fmin_ordered(fmin_ordered(x.cell_exit, y.cell_exit), fmin_ordered(z.cell_exit, end));
      out->begin[n] = s;
      out->place[n] = 0.5f * (s + exit);
      out->size[n] = exit - s;
      dda_brick_store(d, n, out);
      out->x[n] = x.cell;
      out->y[n] = y.cell;
      out->z[n] = z.cell;
      n += exit > s;
      s = exit > s ? exit : s;
      axis_step_cell(&x, exit);
      axis_step_cell(&y, exit);
      axis_step_cell(&z, exit);
    } while (n < W && s < end);
    d->x = x;
    d->y = y;
    d->z = z;
    d->s = s;
  }
  out->count = n;
  segments_pad(out);
}

#endif
