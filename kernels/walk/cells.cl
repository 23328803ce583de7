// Placement of the DDA methods: segments between the crossings of cell faces, empty bricks skipped.
#ifndef BRUME_WALK_CELLS_CL
#define BRUME_WALK_CELLS_CL
#include "density/dda.cl"

static inline int cells_next_brick(const Scene* scene, const Medium* medium, const MediumRay* ray, Dda* d) {
  if (!dda_next_brick(scene, medium, d)) return 0;
  axis_enter_brick(&d->x, ray->origin.x, ray->dir.x, d->s);
  axis_enter_brick(&d->y, ray->origin.y, ray->dir.y, d->s);
  axis_enter_brick(&d->z, ray->origin.z, ray->dir.z, d->s);
  return 1;
}

// Every turn of the loop moves s or steps an axis. What has no length is overwritten by the next segment. The axes are
// copied: behind a pointer the compiler must take the segments' stores for changes of them, and each step would wait
// for memory.
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

static inline void axis_whole(float origin, float dir, float length, floatW cell, floatW* enter, floatW* leave) {
  if (!(fabs(dir) * length > 1e-30f)) return;
  const float inv_dir = 1.0f / dir;
  const floatW a = (cell - origin) * inv_dir, b = (cell + 1.0f - origin) * inv_dir;
  *enter = fmax(*enter, fmin(a, b));
  *leave = fmin(*leave, fmax(a, b));
}

// Of segments that are cut to a part of the ray the whole, from face to face.
static inline void cells_whole(const MediumRay* ray, Segments* at) {
  const floatW begin = lanes_load(at->begin), size = lanes_load(at->size);
  floatW enter = (floatW)(0.0f), leave = (floatW)(ray->length);
  axis_whole(ray->origin.x, ray->dir.x, ray->length, lanes_load(at->x), &enter, &leave);
  axis_whole(ray->origin.y, ray->dir.y, ray->length, lanes_load(at->y), &enter, &leave);
  axis_whole(ray->origin.z, ray->dir.z, ray->length, lanes_load(at->z), &enter, &leave);
  enter = fmin(enter, begin);
  leave = fmax(leave, begin + size);
  lanes_store(enter, at->begin);
  lanes_store(0.5f * (enter + leave), at->place);
  lanes_store(lanes_select((floatW)(0.0f), leave - enter, size > 0.0f), at->size);
}

#endif
