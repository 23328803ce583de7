// Placement of the DDA methods: segments between the crossings of cell faces, empty bricks skipped.
#ifndef BRUME_WALK_CELLS_CL
#define BRUME_WALK_CELLS_CL
#include "density/dda.cl"

__attribute__((always_inline)) static inline int cells_next_brick(const Scene* scene, const Medium* medium,
                                                                  const MediumRay* ray, Dda* d) {
  if (!dda_next_brick(scene, medium, d)) return 0;
  axis_enter_brick(&d->x, ray->origin.x, ray->dir.x, d->s);
  axis_enter_brick(&d->y, ray->origin.y, ray->dir.y, d->s);
  axis_enter_brick(&d->z, ray->origin.z, ray->dir.z, d->s);
  return 1;
}

// The three axes side by side, and the end of the brick as a fourth that is never stepped over. A step waits for the
// one before: what comes behind each plane is worked out before it is known which one is crossed.
typedef struct {
  float4 origin, inv_dir, step, ahead;  // as in DdaAxis
  float4 plane;                         // ahead of each
  float4 exit;                          // the s of that
} CellSteps;

static inline float4 cells_crossing(const CellSteps* c, float4 plane) { return (plane - c->origin) * c->inv_dir; }

static inline CellSteps cells_begin(const Dda* d) {
  CellSteps c;
  c.origin = (float4)(d->x.origin, d->y.origin, d->z.origin, 0.0f);
  c.inv_dir = (float4)(d->x.inv_dir, d->y.inv_dir, d->z.inv_dir, 1.0f);
  c.step = (float4)(d->x.step, d->y.step, d->z.step, 0.0f);
  c.ahead = (float4)(d->x.ahead, d->y.ahead, d->z.ahead, 0.0f);
  c.plane = (float4)(d->x.cell, d->y.cell, d->z.cell, d->brick_end) + c.ahead;
  c.exit = cells_crossing(&c, c.plane);
  return c;
}

static inline float cells_exit(const CellSteps* c) {
  const float2 sooner = fmin_ordered(c->exit.lo, c->exit.hi);
  return fmin_ordered(sooner.x, sooner.y);
}

static inline void cells_step(CellSteps* c, float exit) {
  const int4 crosses = c->exit <= (float4)(exit);
  const float4 behind = c->plane + c->step;
  c->exit = select(c->exit, cells_crossing(c, behind), crosses);
  c->plane = select(c->plane, behind, crosses);
}

// Every turn of the loop moves s or steps an axis. What has no length is overwritten by the next segment. The walk is
// copied: behind a pointer the compiler must take the segments' stores for changes of it, and each step would wait for
// memory.
static inline void cells_fill(const Scene* scene, const Medium* medium, const MediumRay* ray, Dda* walk,
                              Segments* out) {
  Dda d = *walk;
  int n = 0;
  while (n < W && (d.s < d.brick_end || cells_next_brick(scene, medium, ray, &d))) {
    CellSteps c = cells_begin(&d);
    float s = d.s;
    float4 cell;
    do {
      const float exit = cells_exit(&c);
      cell = c.plane - c.ahead;
      out->begin[n] = s;
      out->place[n] = 0.5f * (s + exit);
      out->size[n] = exit - s;
      dda_brick_store(&d, n, out);
      out->x[n] = cell.x;
      out->y[n] = cell.y;
      out->z[n] = cell.z;
      n += exit > s;
      s = exit > s ? exit : s;
      cells_step(&c, exit);
    } while (n < W && s < d.brick_end);
    cell = c.plane - c.ahead;
    d.x.cell = cell.x;
    d.y.cell = cell.y;
    d.z.cell = cell.z;
    d.s = s;
  }
  *walk = d;
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
