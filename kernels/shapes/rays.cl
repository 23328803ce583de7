// W rays side by side and what each has hit: as arrays, of which one ray is taken, and as lanes.
#ifndef BRUME_SHAPES_RAYS_CL
#define BRUME_SHAPES_RAYS_CL
#include "lib/vec.cl"
#include "shared/ray.h"
#include "shared/shape.h"

#if W > 1

#define PACKET_DONE (-1.0f)  // t of a ray that has nothing left to find

// Each number of all rays side by side.
typedef struct {
  float origin[3][W], dir[3][W];
  float t[W], u[W], v[W];
  int primitive[W], instance[W];
} RayLanes;

typedef struct {
  LaneVectors origin, dir;
} RayPacket;

typedef struct {
  floatW t, u, v;
  intW primitive;
} PacketHit;

#define lanes_load_int(p) LANES_GLUE(vload, BRUME_LANES)(0, p)
#define lanes_store_int(v, p) LANES_GLUE(vstore, BRUME_LANES)(v, 0, p)

#define lowest_bit(mask) ((int)popcount(((mask) & -(mask)) - 1u))

// Bit i: the condition of lane i, which is 0 or -1. Bytes of all bits or none keep one each and are summed by a
// product.
#define BYTES_BITS(bytes) ((uint)((((bytes)&0x8040201008040201ul) * 0x0101010101010101ul) >> 56))
static inline uint lanes_bits(intW condition) {
#if W == 16
  const ulong2 bytes = as_ulong2(convert_char16(condition));
  return BYTES_BITS(bytes.x) | BYTES_BITS(bytes.y) << 8;
#elif W == 8
  return BYTES_BITS(as_ulong(convert_char8(condition)));
#else
  return BYTES_BITS((ulong)as_uint(convert_char4(condition)));
#endif
}

static inline float3 lane_vector(float v[3][W], int lane) { return (float3)(v[0][lane], v[1][lane], v[2][lane]); }

// t_max not above 0: nothing is looked for.
static inline void ray_lane_set(RayLanes* rays, int lane, float3 origin, float3 dir, float t_max) {
  rays->origin[0][lane] = origin.x;
  rays->origin[1][lane] = origin.y;
  rays->origin[2][lane] = origin.z;
  rays->dir[0][lane] = dir.x;
  rays->dir[1][lane] = dir.y;
  rays->dir[2][lane] = dir.z;
  rays->t[lane] = t_max;
}

// Before the first shape is tried.
static inline void rays_hit_nothing(RayLanes* rays) {
  lanes_store((floatW)(0.0f), rays->u);
  lanes_store((floatW)(0.0f), rays->v);
  lanes_store_int((intW)(PRIMITIVE_NONE), rays->primitive);
  lanes_store_int((intW)(INSTANCE_NONE), rays->instance);
}

static inline Hit ray_lane_hit(const RayLanes* rays, int lane) {
  Hit hit;
  hit.t = rays->t[lane];
  hit.primitive = rays->primitive[lane];
  hit.u = rays->u[lane];
  hit.v = rays->v[lane];
  hit.instance = rays->instance[lane];
  hit.in_media = 0;
  return hit;
}

static inline void ray_lane_hits(RayLanes* rays, int lane, const Hit* hit) {
  rays->t[lane] = hit->t;
  rays->primitive[lane] = hit->primitive;
  rays->u[lane] = hit->u;
  rays->v[lane] = hit->v;
  rays->instance[lane] = hit->instance;
}

static inline RayPacket packet_of_rays(const RayLanes* rays) {
  RayPacket packet;
  for (int axis = 0; axis < 3; ++axis) {
    packet.origin.v[axis] = lanes_load(rays->origin[axis]);
    packet.dir.v[axis] = lanes_load(rays->dir[axis]);
  }
  return packet;
}

static inline PacketHit packet_of_hits(const RayLanes* rays) {
  PacketHit packet;
  packet.t = lanes_load(rays->t);
  packet.u = lanes_load(rays->u);
  packet.v = lanes_load(rays->v);
  packet.primitive = lanes_load_int(rays->primitive);
  return packet;
}

static inline void packet_to_hits(const PacketHit* packet, RayLanes* rays) {
  lanes_store(packet->t, rays->t);
  lanes_store(packet->u, rays->u);
  lanes_store(packet->v, rays->v);
  lanes_store_int(packet->primitive, rays->primitive);
}

#endif
#endif
