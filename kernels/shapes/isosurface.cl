// The surface on which the density of a grid is iso. The ray goes through the bricks of the grid that hold iso, W cells
// at a time; cells whose corners lie on both sides are looked into (cell_crossing.cl).
#ifndef BRUME_SHAPES_ISOSURFACE_CL
#define BRUME_SHAPES_ISOSURFACE_CL
#include "density/dda.cl"
#include "density/density.cl"
#include "shapes/cell_crossing.cl"
#include "shapes/shape.cl"

#define SIDE_UNKNOWN (-1)  // else 0 outside, 1 inside

// The grid as a medium, of which only what places it is read.
static inline Medium isosurface_grid(const Isosurface* s) {
  Medium m;
  m.cell_from_world = s->cell_from_world;
  m.lo = s->lo;
  m.hi = s->hi;
  m.brick_offset = s->brick_offset;
  m.cells_x = s->cells_x;
  m.cells_y = s->cells_y;
  m.cells_z = s->cells_z;
  m.brick_nx = s->brick_nx;
  m.brick_ny = s->brick_ny;
  m.brick_nz = s->brick_nz;
  m.interpolation = INTERPOLATION_TRILINEAR;
  m.region = REGION_BOX;
  m.is_constant = 0;
  m.constant_density = 0.0f;
  return m;
}

static inline Isosurface isosurface_of(const Scene* scene, const Shape* shape) {
  return scene->isosurfaces[(int)shape->data[0]];
}

// Up to W cells of one brick along the ray, where it goes through them, and their corners.
typedef struct {
  int count;
  float begin[W], end[W];
  float x[W], y[W], z[W];
  float corner[8][W];
  float low[W], high[W];  // of the corners
} Cells;

// The next cells of the brick in which the walk stands.
static inline void cells_next(Dda* d, Cells* out) {
  DdaAxis x = d->x, y = d->y, z = d->z;
  float s = d->s;
  int n = 0;
  while (n < W && s < d->brick_end) {
    const float exit = fmin_ordered(fmin_ordered(x.cell_exit, y.cell_exit), fmin_ordered(z.cell_exit, d->brick_end));
    out->begin[n] = s;
    out->end[n] = exit;
    out->x[n] = x.cell;
    out->y[n] = y.cell;
    out->z[n] = z.cell;
    n += exit > s;
    s = exit > s ? exit : s;
    axis_step_cell(&x, exit);
    axis_step_cell(&y, exit);
    axis_step_cell(&z, exit);
  }
  out->count = n;
  for (int i = n; i < W; ++i) {  // looks up the first, for nothing
    out->x[i] = out->x[0];
    out->y[i] = out->y[0];
    out->z[i] = out->z[0];
  }
  d->x = x;
  d->y = y;
  d->z = z;
  d->s = s;
}

static inline void cells_load(const Scene* scene, const Dda* d, Cells* cells) {
  const intW sample = (intW)(d->base) + brick_stride(lanes_to_int(lanes_load(cells->x)), lanes_to_int(lanes_load(cells->y)),
                                                     lanes_to_int(lanes_load(cells->z)));
  floatW low = (floatW)(INFINITY), high = (floatW)(-INFINITY), a, b;
  for (int i = 0; i < 4; ++i) {
    voxels_gather2(scene->voxels + brick_stride(0, i & 1, i >> 1), sample, &a, &b);
#if BRUME_STORAGE == 2
    a = mad_exact(a, (floatW)(d->part), (floatW)(d->zero));
    b = mad_exact(b, (floatW)(d->part), (floatW)(d->zero));
#endif
    lanes_store(a, cells->corner[2 * i]);
    lanes_store(b, cells->corner[2 * i + 1]);
    low = fmin_ordered(low, fmin_ordered(a, b));
    high = fmax_ordered(high, fmax_ordered(a, b));
  }
  lanes_store(low, cells->low);
  lanes_store(high, cells->high);
}

static inline CellRay cell_ray(const MediumRay* ray, const Cells* cells, int i, float iso) {
  CellRay c;
  for (int k = 0; k < 8; ++k) c.corner[k] = cells->corner[k][i];
  c.iso = iso;
  const float3 cell = (float3)(cells->x[i], cells->y[i], cells->z[i]);
  c.p = fmin(fmax(vec_point(ray->origin, ray->dir, cells->begin[i]) - cell, 0.0f), 1.0f);
  c.d = ray->dir * (cells->end[i] - cells->begin[i]);
  return c;
}

// s of the first crossing in the cells, or CROSSING_NONE.
static inline float cells_crossing(const MediumRay* ray, const Cells* cells, float iso, int* inside) {
  const floatW low = lanes_load(cells->low), high = lanes_load(cells->high);
  if (*inside == 0 && lanes_all(high <= (floatW)(iso))) return CROSSING_NONE;
  if (*inside == 1 && lanes_all(low > (floatW)(iso))) return CROSSING_NONE;
  for (int i = 0; i < cells->count; ++i) {
    if (cells->low[i] <= iso && cells->high[i] > iso) {
      const CellRay cell = cell_ray(ray, cells, i, iso);
      const float u = cell_crossing(&cell, inside);
      if (u >= 0.0f) return mad_exact(u, cells->end[i] - cells->begin[i], cells->begin[i]);
      continue;
    }
    const int before = *inside;
    *inside = cells->low[i] > iso;
    if (before != *inside && before != SIDE_UNKNOWN) return cells->begin[i];
  }
  return CROSSING_NONE;
}

// The same of the brick in which the walk stands; afterwards it stands at its end.
static inline float brick_crossing(const Scene* scene, const MediumRay* ray, Dda* d, float iso, int* inside) {
  axis_enter_brick(&d->x, ray->origin.x, ray->dir.x, d->s);
  axis_enter_brick(&d->y, ray->origin.y, ray->dir.y, d->s);
  axis_enter_brick(&d->z, ray->origin.z, ray->dir.z, d->s);
  while (d->s < d->brick_end) {
    Cells cells;
    cells_next(d, &cells);
    cells_load(scene, d, &cells);
    const float s = cells_crossing(ray, &cells, iso, inside);
    if (s >= 0.0f) return s;
  }
  return CROSSING_NONE;
}

// On which side all of a brick lies, SIDE_UNKNOWN where it holds iso.
static inline int brick_side(const Scene* scene, int entry, float iso) {
  if (entry == BRICK_EMPTY) return 0;
  const float2 range = vload2(entry, scene->ranges);
  return range.x > iso ? 1 : (range.y <= iso ? 0 : SIDE_UNKNOWN);
}

// s of the first crossing along the walk, or CROSSING_NONE.
static inline float grid_crossing(const Scene* scene, const Medium* grid, const MediumRay* ray, float end, float iso,
                                  int* inside) {
  Dda d = dda_begin(grid, ray, 0.0f);
  for (int within = 1; within && d.s < end; within = dda_step_brick(grid, &d)) {
    const float exit = fmin(dda_brick_exit(&d), end);
    if (!(exit > d.s)) continue;
    const int entry = dda_brick_entry(scene, grid, &d), side = brick_side(scene, entry, iso);
    if (side != SIDE_UNKNOWN) {
      const int before = *inside;
      *inside = side;
      if (before != side && before != SIDE_UNKNOWN) return d.s;
      d.s = exit;
      continue;
    }
    d.brick_end = exit;
    d.base = brick_base(entry, (int)d.x.brick, (int)d.y.brick, (int)d.z.brick);
#if BRUME_STORAGE == 2
    const float2 scale = brick_scale(scene, entry);
    d.zero = scale.x;
    d.part = scale.y;
#endif
    const float s = brick_crossing(scene, ray, &d, iso, inside);
    if (s >= 0.0f) return s;
  }
  return CROSSING_NONE;
}

// Which side of the border of the grid a point lies on: 1 + 2 axis + (1 on the upper one).
static inline float border_at(const Medium* grid, float3 p) {
  const float3 below = fabs(p - vec_unpack(grid->lo)), above = fabs(vec_unpack(grid->hi) - p), off = fmin(below, above);
  if (off.x <= off.y && off.x <= off.z) return above.x < below.x ? 2.0f : 1.0f;
  if (off.y <= off.z) return above.y < below.y ? 4.0f : 3.0f;
  return above.z < below.z ? 6.0f : 5.0f;
}

// Nearest crossing with 0 < t < hit->t, in shape `index`; outside of the grid is outside.
OUTLINED void isosurface_hit(const Scene* scene, const Shape* shape, int index, float3 origin, float3 dir, Hit* hit) {
  const Isosurface surface = isosurface_of(scene, shape);
  const Medium grid = isosurface_grid(&surface);
  const MediumRay ray = medium_ray(&grid, origin, dir, INFINITY);
  if (!(ray.length > 0.0f) || !(ray.t_begin < hit->t)) return;
  const float end = fmin(ray.length, hit->t - ray.t_begin);
  int inside = ray.t_begin > 0.0f ? 0 : SIDE_UNKNOWN;
  float s = grid_crossing(scene, &grid, &ray, end, surface.iso, &inside);
  int border = s == 0.0f;
  if (s < 0.0f) {
    if (inside != 1 || !(end >= ray.length)) return;
    s = ray.length;
    border = 1;
    inside = 0;
  }
  const float t = ray.t_begin + s;
  if (!(t > 0.0f && t < hit->t)) return;
  hit->t = t;
  hit->primitive = index;
  hit->u = border ? border_at(&grid, vec_point(ray.origin, ray.dir, s)) : 0.0f;
  hit->v = inside ? 0.0f : 1.0f;
}

// Rise of the density from a to b, apart along one axis, per cell, W or fewer at a time.
#define RISES 6  // of both gradients
static inline void density_rises(const Scene* scene, const Medium* grid, const float3* a, const float3* b, float* rise) {
  for (int first = 0; first < 2 * RISES; first += W) {
    float p[3][W], density[W];
    for (int i = 0; i < W; ++i) {
      const int k = min(first + i, 2 * RISES - 1);
      const float3 at = k & 1 ? b[k >> 1] : a[k >> 1];
      p[0][i] = at.x;
      p[1][i] = at.y;
      p[2][i] = at.z;
    }
    lanes_store(density_at(scene, grid, lanes_load(p[0]), lanes_load(p[1]), lanes_load(p[2])), density);
    for (int i = 0; i < W && first + i < 2 * RISES; ++i) {
      const int k = (first + i) >> 1;
      rise[k] = (first + i) & 1 ? rise[k] + density[i] : -density[i];
    }
  }
  for (int k = 0; k < RISES; ++k) {
    const float3 apart = b[k] - a[k];
    rise[k] /= fmax(apart.x + apart.y + apart.z, FLT_MIN);
  }
}

static inline float3 axis_unit(int axis) {
  return (float3)(axis == 0 ? 1.0f : 0.0f, axis == 1 ? 1.0f : 0.0f, axis == 2 ? 1.0f : 0.0f);
}

// A normal of cell space in the world: by the transpose of the map from world to cells.
static inline float3 normal_to_world(const Isosurface* s, float3 n) {
  const float* m = s->cell_from_world.m;
  return vec_unit((float3)(m[0] * n.x + m[4] * n.y + m[8] * n.z, m[1] * n.x + m[5] * n.y + m[9] * n.z,
                           m[2] * n.x + m[6] * n.y + m[10] * n.z));
}

// Outward normals at a hit: of the cell's own density, and of central differences, which do not break at its faces.
OUTLINED float3 isosurface_normals(const Scene* scene, const Shape* shape, float3 point, float3 dir, const Hit* hit,
                                   float3* geometric) {
  const Isosurface surface = isosurface_of(scene, shape);
  if (hit->u > 0.0f) {
    const int side = (int)hit->u - 1;
    return *geometric = normal_to_world(&surface, axis_unit(side >> 1) * (side & 1 ? 1.0f : -1.0f));
  }
  const Medium grid = isosurface_grid(&surface);
  const float3 lo = vec_unpack(grid.lo), hi = vec_unpack(grid.hi);
  const float3 p = fmin(fmax(affine_point(&grid.cell_from_world, point), lo), hi), cell = floor(p);
  float3 a[RISES], b[RISES];
  for (int axis = 0; axis < 3; ++axis) {
    const float3 along = axis_unit(axis), across = 1.0f - along;
    a[axis] = fmax(p * across + cell * along, lo);
    b[axis] = fmin(p * across + (cell + 1.0f) * along, hi);
    a[3 + axis] = fmax(p - along, lo);
    b[3 + axis] = fmin(p + along, hi);
  }
  float rise[RISES];
  density_rises(scene, &grid, a, b, rise);
  float3 own = normal_to_world(&surface, -(float3)(rise[0], rise[1], rise[2]));
  const float3 smooth = (float3)(rise[3], rise[4], rise[5]);
  // By rounding it may face the other way than the ray, which knows on which side it was.
  const float along = dot(own, dir);
  if ((along > 0.0f) != (hit->v > 0.0f)) own = vec_unit(own - along * dir);
  *geometric = own;
  if (!(vec_max_abs(smooth) > 0.0f)) return own;
  const float3 normal = normal_to_world(&surface, -smooth);
  // Mirrored by it a ray must not go into the surface.
  const float mirrored = dot(own, dir) - 2.0f * dot(normal, dir) * dot(normal, own);
  return (mirrored > 0.0f) == (hit->v == 0.0f) ? normal : own;
}

#endif
