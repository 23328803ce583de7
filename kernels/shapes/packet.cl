// W rays that go about the same way through the BVH together: lanes are boxes where a node is opened, triangles where a
// block is looked at as a whole, and rays where a triangle is met. A ray meets a triangle at the same bits as alone.
#ifndef BRUME_SHAPES_PACKET_CL
#define BRUME_SHAPES_PACKET_CL
#include "shapes/bvh.cl"
#include "shapes/rays.cl"

#if W > 1

#define PACKET_SPREAD 0.125f  // of a component of the directions: of more, the boxes that one of them meets are many

static inline float lanes_least(floatW v) {
#if W == 16
  const float8 both = fmin_ordered(v.lo, v.hi);
  const float4 w = fmin_ordered(both.lo, both.hi);
#elif W == 8
  const float4 w = fmin_ordered(v.lo, v.hi);
#else
  const float4 w = v;
#endif
  const float2 pair = fmin_ordered(w.lo, w.hi);
  return fmin_ordered(pair.x, pair.y);
}
static inline float lanes_most(floatW v) { return -lanes_least(-v); }

static inline float3 packet_least(const LaneVectors* p) {
  return (float3)(lanes_least(p->v[0]), lanes_least(p->v[1]), lanes_least(p->v[2]));
}
static inline float3 packet_most(const LaneVectors* p) {
  return (float3)(lanes_most(p->v[0]), lanes_most(p->v[1]), lanes_most(p->v[2]));
}

// What all rays of a packet meet lies between two: of the largest and of the smallest components of the directions.
typedef struct {
  BoxRay steep, flat;
  int kz;  // the axis along which every ray goes farthest
} PacketBox;

// 0 where they do not go about the same way: other signs, another longest axis.
static inline int packet_box(const RayPacket* rays, PacketBox* box) {
  const float3 low = packet_least(&rays->dir), high = packet_most(&rays->dir);
  const float3 from = packet_least(&rays->origin), to = packet_most(&rays->origin);
  if (any((signbit(low) != signbit(high)) | (high - low > PACKET_SPREAD))) return 0;
  const float3 near = fmin(fabs(low), fabs(high)), far = fmax(fabs(low), fabs(high));
  box->kz = near.x > far.y ? (near.x > far.z ? 0 : 2) : (near.y > far.z ? 1 : 2);
  const float others = box->kz == 0 ? fmax(far.y, far.z) : (box->kz == 1 ? fmax(far.x, far.z) : fmax(far.x, far.y));
  if (!(vec_axis(near, box->kz) > others)) return 0;
  const int3 back = signbit(low);
  const float3 first = select(to, from, back), last = select(from, to, back);  // origins that meet a plane first, last
  const float3 one = copysign((float3)(1.0f), low);
  const float3 steep = one * fmax(far, (float3)(DIRECTION_LEAST)), flat = one * fmax(near, (float3)(DIRECTION_LEAST));
  box->steep = box_ray_between(first, last, 1.0f / steep);
  box->flat = box_ray_between(first, last, 1.0f / flat);
  return 1;
}

// Planes that the rays meet between the least and the most of both: entry and exit of one axis.
#define PACKET_NEAR(box, plane, axis) \
  fmin_ordered(BOX_PLANE(&(box)->steep, plane, near, axis), BOX_PLANE(&(box)->flat, plane, near, axis))
#define PACKET_FAR(box, plane, axis) \
  fmax_ordered(BOX_PLANE(&(box)->steep, plane, far, axis), BOX_PLANE(&(box)->flat, plane, far, axis))

static inline BvhMask packet_box_hits(const PacketBox* box, BvhLanes near_x, BvhLanes near_y, BvhLanes near_z,
                                      BvhLanes far_x, BvhLanes far_y, BvhLanes far_z, float t_max, BvhLanes* enter) {
  const BvhLanes first = fmax_ordered(PACKET_NEAR(box, near_x, x), PACKET_NEAR(box, near_y, y));
  const BvhLanes last = fmin_ordered(PACKET_FAR(box, far_x, x), PACKET_FAR(box, far_y, y));
  *enter = fmax_ordered(first, fmax_ordered(PACKET_NEAR(box, near_z, z), (BvhLanes)(0.0f)));
  return bvh_mask(*enter <= fmin_ordered(last, fmin_ordered(PACKET_FAR(box, far_z, z), (BvhLanes)(t_max))));
}

static inline int packet_open(const Scene* scene, const PacketBox* box, int node, float t_max, BvhEntry* stack,
                              int* top) {
  __global const float* p = scene->bvh_nodes + (size_t)node * BVH_NODE_FLOATS(BRUME_BVH_WIDTH);
  const BoxRay* r = &box->steep;
  BvhEntry nearest = {INFINITY, BVH_ABSENT};
  BvhLanes enter;
  const BvhMask mask =
      packet_box_hits(box, bvh_load(p + r->near_x), bvh_load(p + r->near_y), bvh_load(p + r->near_z),
                      bvh_load(p + r->far_x), bvh_load(p + r->far_y), bvh_load(p + r->far_z), t_max, &enter);
  bvh_stack(mask, enter, (__global const int*)(p + 6 * BRUME_BVH_WIDTH), &nearest, stack, top);
  return nearest.link;
}

// Which triangles of a block some ray may hit, by the box of each.
static inline BvhMask packet_block(const PacketBox* box, __global const float* p, float t_max) {
#define CORNER(c, k) bvh_load(p + ((c)*3 + (k)) * BRUME_BVH_WIDTH)
#define LOW(k) fmin_ordered(fmin_ordered(CORNER(0, k), CORNER(1, k)), CORNER(2, k))
#define HIGH(k) fmax_ordered(fmax_ordered(CORNER(0, k), CORNER(1, k)), CORNER(2, k))
#define NEAR(axis, k) (box->steep.far.axis < 0.0f ? HIGH(k) : LOW(k))
#define FAR(axis, k) (box->steep.far.axis < 0.0f ? LOW(k) : HIGH(k))
  BvhLanes enter;
  return packet_box_hits(box, NEAR(x, 0), NEAR(y, 1), NEAR(z, 2), FAR(x, 0), FAR(y, 1), FAR(z, 2), t_max, &enter);
#undef FAR
#undef NEAR
#undef HIGH
#undef LOW
#undef CORNER
}

// ShearedRay of each lane.
typedef struct {
  int kx, ky, kz;
  floatW sx, sy, sz, ox, oy, oz;
} ShearedPacket;

static inline ShearedPacket packet_shear(const RayPacket* rays, int kz) {
  ShearedPacket r;
  r.kz = kz;
  r.kx = kz == 2 ? 0 : kz + 1;
  r.ky = r.kx == 2 ? 0 : r.kx + 1;
  const floatW dz = rays->dir.v[kz];
  r.sx = rays->dir.v[r.kx] / dz;
  r.sy = rays->dir.v[r.ky] / dz;
  r.sz = 1.0f / dz;
  r.ox = rays->origin.v[r.kx];
  r.oy = rays->origin.v[r.ky];
  r.oz = rays->origin.v[kz];
  return r;
}

// One triangle against all rays. p: its first corner's first component.
static inline void packet_triangle(const ShearedPacket* r, __global const float* p, int primitive, PacketHit* hit) {
#define CORNER(c, k) ((floatW)(p[((c)*3 + (k)) * BRUME_BVH_WIDTH]))
  TRIANGLE_EDGES(floatW, CORNER, r);
#undef CORNER
  const intW inside = TRIANGLE_INSIDE;
  if (!lanes_any(inside)) return;
  TRIANGLE_PLACE(floatW, r);
  const intW better = inside & (t > 0.0f) & ((t < hit->t) | ((t == hit->t) & (primitive < hit->primitive)));
  hit->t = lanes_select(hit->t, t, better);
  hit->u = lanes_select(hit->u, u, better);
  hit->v = lanes_select(hit->v, v, better);
  hit->primitive = select(hit->primitive, (intW)(primitive), better);
}

static inline void packet_leaf(const Scene* scene, const PacketBox* box, const ShearedPacket* rays, int link, int any,
                               PacketHit* hit, float* t_max) {
  const int first = (~link) >> 4, count = (~link) & 15;
  for (int block = first; block < first + count; ++block) {
    __global const float* corners = scene->bvh_blocks + (size_t)block * BVH_BLOCK_FLOATS(BRUME_BVH_WIDTH);
    __global const int* ids = (__global const int*)(corners + 9 * BRUME_BVH_WIDTH);
    BvhMask mask = packet_block(box, corners, *t_max);
    if (mask == 0) continue;
    for (; mask != 0; mask &= mask - 1) {
      const int lane = bvh_lowest(mask);
      packet_triangle(rays, corners + lane, FIRST_TRIANGLE + ids[lane], hit);
    }
    if (any) hit->t = lanes_select(hit->t, (floatW)(PACKET_DONE), hit->primitive != PRIMITIVE_NONE);
    *t_max = lanes_most(hit->t);
  }
}

// bvh_hit of W rays; 0, and nothing done, where they do not go about the same way. Of `any`, t is PACKET_DONE of those
// that hit something.
BVH_CALLED int packet_hit(const Scene* scene, int root, const RayPacket* rays, int any, PacketHit* hit) {
  PacketBox box;
  if (!packet_box(rays, &box)) return 0;
  const ShearedPacket sheared = packet_shear(rays, box.kz);
  float t_max = lanes_most(hit->t);
  BvhEntry stack[BVH_STACK];
  int top = 0, link = root;
  while (link != BVH_ABSENT) {
    if (link >= 0) {
      link = packet_open(scene, &box, link, t_max, stack, &top);
      if (link != BVH_ABSENT) continue;
    } else {
      packet_leaf(scene, &box, &sheared, link, any, hit, &t_max);
      if (t_max < 0.0f) return 1;
    }
    link = bvh_pop(stack, &top, t_max);
  }
  return 1;
}

#endif
#endif
