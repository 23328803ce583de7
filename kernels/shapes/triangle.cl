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

// The sums of the test, once for lanes of triangles and for lanes of rays (packet.cl), which meet at the same bits. r:
// ShearedRay or ShearedPacket; CORNER(c, k): component k of corner c.
#define TRIANGLE_ALONG(Lanes, CORNER, r, k, o, s, c, z) mad_exact((Lanes)(-(r)->s), z, CORNER(c, (r)->k) - (r)->o)
#define TRIANGLE_EDGES(Lanes, CORNER, r)                                                                               \
  const Lanes az = CORNER(0, (r)->kz) - (r)->oz, bz = CORNER(1, (r)->kz) - (r)->oz, cz = CORNER(2, (r)->kz) - (r)->oz; \
  const Lanes ax = TRIANGLE_ALONG(Lanes, CORNER, r, kx, ox, sx, 0, az);                                                \
  const Lanes ay = TRIANGLE_ALONG(Lanes, CORNER, r, ky, oy, sy, 0, az);                                                \
  const Lanes bx = TRIANGLE_ALONG(Lanes, CORNER, r, kx, ox, sx, 1, bz);                                                \
  const Lanes by = TRIANGLE_ALONG(Lanes, CORNER, r, ky, oy, sy, 1, bz);                                                \
  const Lanes cx = TRIANGLE_ALONG(Lanes, CORNER, r, kx, ox, sx, 2, cz);                                                \
  const Lanes cy = TRIANGLE_ALONG(Lanes, CORNER, r, ky, oy, sy, 2, cz);                                                \
  const Lanes e0 = cx * by - cy * bx, e1 = ax * cy - ay * cx, e2 = bx * ay - by * ax; /* no fma: see above */          \
  const Lanes low = fmin_ordered(fmin_ordered(e0, e1), e2), high = fmax_ordered(fmax_ordered(e0, e1), e2);             \
  const Lanes det = e0 + e1 + e2
#define TRIANGLE_INSIDE (((low >= 0.0f) | (high <= 0.0f)) & (det != 0.0f))
// inv_det: inf for a degenerate or edge-on triangle. Shares before lengths: three lengths of a small triangle in a
// large scene multiply to nothing.
#define TRIANGLE_PLACE(Lanes, r)                                        \
  const Lanes inv_det = 1.0f / det, u = e1 * inv_det, v = e2 * inv_det; \
  const Lanes t = (e0 * inv_det * az + u * bz + v * cz) * (r)->sz

typedef struct {
  BvhLanes t, u, v;
} TriangleHits;

// Which triangles are hit at 0 < t <= t_max. p: 9 runs of BRUME_BVH_WIDTH floats, the block's first lane of this group.
static inline BvhMask triangle_hits(const ShearedRay* r, __global const float* p, float t_max, TriangleHits* hits) {
#define CORNER(c, k) bvh_load(p + ((c)*3 + (k)) * BRUME_BVH_WIDTH)
  TRIANGLE_EDGES(BvhLanes, CORNER, r);
#undef CORNER
  if (bvh_mask(TRIANGLE_INSIDE) == 0) return 0;
  TRIANGLE_PLACE(BvhLanes, r);
  hits->t = t;
  hits->u = u;
  hits->v = v;
  return bvh_mask(TRIANGLE_INSIDE & (t > 0.0f) & (t <= t_max));
}

#endif
