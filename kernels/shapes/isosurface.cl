// The surface on which the density of a grid is iso. The ray goes through the bricks of the grid that hold iso, cell by
// cell; cells whose corners lie on both sides are looked into (cell_crossing.cl).
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
  m.liquid = -1;
  m.constant_density = 0.0f;
  return m;
}

static inline Isosurface isosurface_of(const Scene* scene, const Shape* shape) {
  return scene->isosurfaces[(int)shape->data[0]];
}

// What of a ray through the grid does not change from brick to brick.
typedef struct {
  MediumRay ray;
  float iso;
  __global const uint* masks;
} IsoRay;

// A cell of the brick in which the walk stands, which the ray crosses from s to exit.
static inline CellRay cell_load(const Scene* scene, const IsoRay* r, const Dda* d, float3 cell, float s, float exit) {
  CellRay c;
  __global const Voxel* voxels = scene->voxels + d->base + brick_stride((int)cell.x, (int)cell.y, (int)cell.z);
  for (int i = 0; i < 4; ++i) {
    float2 pair = LOAD2_VOXEL(voxels + brick_stride(0, i & 1, i >> 1));
#if BRUME_STORAGE == 2
    pair = (float2)(mad_exact(pair.x, d->part, d->zero), mad_exact(pair.y, d->part, d->zero));
#endif
    c.corner[2 * i] = pair.x;
    c.corner[2 * i + 1] = pair.y;
  }
  c.iso = r->iso;
  c.p = fmin(fmax(vec_point(r->ray.origin, r->ray.dir, s) - cell, 0.0f), 1.0f);
  c.d = r->ray.dir * (exit - s);
  return c;
}

// s of the first crossing in the brick in which the walk stands, or CROSSING_NONE. Only cells whose bit is set can hold
// one; where the walk begins, on the border of the grid or within it, its side is asked.
static inline float brick_crossing(const Scene* scene, const IsoRay* r, Dda* d, int* inside) {
  __global const uint* mask = r->masks + d->number * ISO_MASK_WORDS;
  axis_enter_brick(&d->x, r->ray.origin.x, r->ray.dir.x, d->s);
  axis_enter_brick(&d->y, r->ray.origin.y, r->ray.dir.y, d->s);
  axis_enter_brick(&d->z, r->ray.origin.z, r->ray.dir.z, d->s);
  DdaAxis x = d->x, y = d->y, z = d->z;
  const float first = BRICK_CELLS * (x.brick + 8.0f * y.brick + 64.0f * z.brick), end = d->brick_end;
  for (float s = d->s; s < end;) {
    const float exit = fmin_ordered(fmin_ordered(x.cell_exit, y.cell_exit), fmin_ordered(z.cell_exit, end));
    const int bit = (int)(x.cell + 8.0f * y.cell + 64.0f * z.cell - first);
    if (((mask[bit >> 5] >> (bit & 31)) & 1u || s == 0.0f) && exit > s) {
      const CellRay cell = cell_load(scene, r, d, (float3)(x.cell, y.cell, z.cell), s, exit);
      const float u = cell_crossing(&cell, inside);
      if (u >= 0.0f) return mad_exact(u, exit - s, s);
    }
    s = fmax_ordered(s, exit);
    axis_step_cell(&x, exit);
    axis_step_cell(&y, exit);
    axis_step_cell(&z, exit);
  }
  d->s = end;
  return CROSSING_NONE;
}

// On which side all of a brick lies, SIDE_UNKNOWN where it holds iso.
static inline int brick_side(const Scene* scene, int entry, float iso) {
  if (entry == BRICK_EMPTY) return 0;
  const float2 range = vload2(entry, scene->ranges);
  return range.x > iso ? 1 : (range.y <= iso ? 0 : SIDE_UNKNOWN);
}

// s of the first crossing along the walk, or CROSSING_NONE.
static inline float grid_crossing(const Scene* scene, const Medium* grid, const IsoRay* r, float end, int* inside) {
  Dda d = dda_begin(grid, &r->ray, 0.0f);
  for (int within = 1; within && d.s < end; within = dda_step_brick(grid, &d)) {
    const float exit = fmin(dda_brick_exit(&d), end);
    if (!(exit > d.s)) continue;
    const int entry = dda_brick_entry(scene, grid, &d), side = brick_side(scene, entry, r->iso);
    if (side != SIDE_UNKNOWN) {
      const int before = *inside;
      *inside = side;
      if (before != side && before != SIDE_UNKNOWN) return d.s;
      d.s = exit;
      continue;
    }
    d.brick_end = exit;
    d.number = entry;
    d.base = brick_base(entry, (int)d.x.brick, (int)d.y.brick, (int)d.z.brick);
#if BRUME_STORAGE == 2
    const float2 scale = brick_scale(scene, entry);
    d.zero = scale.x;
    d.part = scale.y;
#endif
    const float s = brick_crossing(scene, r, &d, inside);
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

// Nearest crossing with 0 < t < hit->t, or at it where what was hit there comes later, in shape `index`; outside of the
// grid is outside.
OUTLINED void isosurface_hit(const Scene* scene, const Shape* shape, int index, float3 origin, float3 dir, Hit* hit) {
  const Isosurface surface = isosurface_of(scene, shape);
  const Medium grid = isosurface_grid(&surface);
  const IsoRay r = {medium_ray(&grid, origin, dir, INFINITY), surface.iso, scene->iso_masks + surface.masks};
  const MediumRay ray = r.ray;
  if (!(ray.length > 0.0f) || !(ray.t_begin < hit->t)) return;
  const float end = fmin(ray.length, hit->t - ray.t_begin);
  int inside = ray.t_begin > 0.0f ? 0 : SIDE_UNKNOWN;
  float s = grid_crossing(scene, &grid, &r, end, &inside);
  int border = s == 0.0f;
  if (s < 0.0f) {
    if (inside != 1 || !(end >= ray.length)) return;
    s = ray.length;
    border = 1;
    inside = 0;
  }
  const float t = ray.t_begin + s;
  if (!(t > 0.0f && (t < hit->t || (t == hit->t && index < hit->primitive)))) return;
  hit->t = t;
  hit->primitive = index;
  hit->u = border ? border_at(&grid, vec_point(ray.origin, ray.dir, s)) : 0.0f;
  hit->v = inside ? 0.0f : 1.0f;
}

// Rise of the density from a to b, apart along one axis, per cell, W or fewer at a time.
#define RISES 6  // of both gradients
static inline void density_rises(const Scene* scene, const Medium* grid, const float3* a, const float3* b,
                                 float* rise) {
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

static inline float3 normal_to_world(const Isosurface* s, float3 n) {
  return vec_unit(affine_normal(&s->cell_from_world, n));
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
