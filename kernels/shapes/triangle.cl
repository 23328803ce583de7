// Watertight ray/triangle test [Woop13], W triangles of a leaf block at once. Edge functions of neighbours are exact
// negatives of each other (no contraction: options.cl), so a ray cannot slip between two triangles.
#ifndef BRUME_SHAPES_TRIANGLE_CL
#define BRUME_SHAPES_TRIANGLE_CL
#include "lib/vec.cl"
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
  floatW t, u, v;  // t = INFINITY for a miss
} TriangleHits;

// p: 9 runs of BRUME_BVH_WIDTH floats, the block's first lane of this group.
static inline TriangleHits triangle_hits(const ShearedRay* r, __global const float* p, float t_max) {
#define CORNER(c, k) lanes_load(p + ((c)*3 + (k)) * BRUME_BVH_WIDTH)
  const floatW az = CORNER(0, r->kz) - r->oz, bz = CORNER(1, r->kz) - r->oz, cz = CORNER(2, r->kz) - r->oz;
  const floatW ax = CORNER(0, r->kx) - r->ox - r->sx * az, ay = CORNER(0, r->ky) - r->oy - r->sy * az;
  const floatW bx = CORNER(1, r->kx) - r->ox - r->sx * bz, by = CORNER(1, r->ky) - r->oy - r->sy * bz;
  const floatW cx = CORNER(2, r->kx) - r->ox - r->sx * cz, cy = CORNER(2, r->ky) - r->oy - r->sy * cz;
#undef CORNER
  const floatW e0 = cx * by - cy * bx, e1 = ax * cy - ay * cx, e2 = bx * ay - by * ax;
  const floatW det = e0 + e1 + e2;
  const floatW inv_det = 1.0f / det;  // inf for a degenerate or edge-on triangle, which `inside` drops
  TriangleHits hits;
  hits.u = e1 * inv_det;
  hits.v = e2 * inv_det;
  // shares before lengths: three lengths of a small triangle in a large scene multiply to nothing
  const floatW t = (e0 * inv_det * az + hits.u * bz + hits.v * cz) * r->sz;
  const intW inside = (((e0 >= 0.0f) & (e1 >= 0.0f) & (e2 >= 0.0f)) | ((e0 <= 0.0f) & (e1 <= 0.0f) & (e2 <= 0.0f))) &
                      (det != 0.0f) & (t > 0.0f) & (t <= t_max);
  hits.t = lanes_select((floatW)(INFINITY), t, inside);
  return hits;
}

#endif
