// Watertight ray/triangle test [Woop13], W triangles of a leaf block at once. Edge functions of neighbours are exact
// negatives of each other (no contraction: options.cl), so a ray cannot slip between two triangles.
#ifndef BRUME_SHAPES_TRIANGLE_CL
#define BRUME_SHAPES_TRIANGLE_CL
#include "lib/vec.cl"
#include "shapes/bvh_lanes.cl"
#include "shared/bvh.h"

// The ray in the space where it is the z axis: k* name the world axes, s* shear.
typedef struct {
  int kx, ky, kz;
  float sx, sy, sz;
  float ox, oy, oz;  // origin along kx, ky, kz
} ShearedRay;

static inline float vec_axis(float3 v, int axis) { return axis == 0 ? v.x : (axis == 1 ? v.y : v.z); }

static inline ShearedRay ray_shear(float3 origin, float3 dir) {
  ShearedRay r;
  const float3 a = fabs(dir);
  r.kz = a.x > a.y ? (a.x > a.z ? 0 : 2) : (a.y > a.z ? 1 : 2);
  r.kx = r.kz == 2 ? 0 : r.kz + 1;
  r.ky = r.kx == 2 ? 0 : r.kx + 1;
  const float dz = vec_axis(dir, r.kz);
  r.sx = vec_axis(dir, r.kx) / dz;
  r.sy = vec_axis(dir, r.ky) / dz;
  r.sz = 1.0f / dz;
  r.ox = vec_axis(origin, r.kx);
  r.oy = vec_axis(origin, r.ky);
  r.oz = vec_axis(origin, r.kz);
  return r;
}

typedef struct {
  BvhLanes t, u, v;
} TriangleHits;

// Which triangles are hit at 0 < t <= t_max. p: 9 runs of BRUME_BVH_WIDTH floats, the block's first lane of this group.
static inline BvhMask triangle_hits(const ShearedRay* r, __global const float* p, float t_max, TriangleHits* hits) {
#define CORNER(c, k) bvh_load(p + ((c)*3 + (k)) * BRUME_BVH_WIDTH)
#define SHEARED(c, k, o, s, z) mad_exact((BvhLanes)(-r->s), z, CORNER(c, r->k) - r->o)
  const BvhLanes az = CORNER(0, r->kz) - r->oz, bz = CORNER(1, r->kz) - r->oz, cz = CORNER(2, r->kz) - r->oz;
  const BvhLanes ax = SHEARED(0, kx, ox, sx, az), ay = SHEARED(0, ky, oy, sy, az);
  const BvhLanes bx = SHEARED(1, kx, ox, sx, bz), by = SHEARED(1, ky, oy, sy, bz);
  const BvhLanes cx = SHEARED(2, kx, ox, sx, cz), cy = SHEARED(2, ky, oy, sy, cz);
#undef SHEARED
#undef CORNER
  const BvhLanes e0 = cx * by - cy * bx, e1 = ax * cy - ay * cx, e2 = bx * ay - by * ax;  // no fma: see above
  const BvhLanes low = fmin_ordered(fmin_ordered(e0, e1), e2), high = fmax_ordered(fmax_ordered(e0, e1), e2);
  const BvhLanes det = e0 + e1 + e2;
  if (bvh_mask(((low >= 0.0f) | (high <= 0.0f)) & (det != 0.0f)) == 0) return 0;
  const BvhLanes inv_det = 1.0f / det;  // inf for a degenerate or edge-on triangle
  hits->u = e1 * inv_det;
  hits->v = e2 * inv_det;
  // shares before lengths: three lengths of a small triangle in a large scene multiply to nothing
  hits->t = (e0 * inv_det * az + hits->u * bz + hits->v * cz) * r->sz;
  return bvh_mask(((low >= 0.0f) | (high <= 0.0f)) & (det != 0.0f) & (hits->t > 0.0f) & (hits->t <= t_max));
}

#endif
