// scene_hit of W rays at once: the same bits (of `any`, the same answer), sooner where the rays go about the same way.
#ifndef BRUME_SHAPES_TOGETHER_CL
#define BRUME_SHAPES_TOGETHER_CL
#include "shapes/instance_packet.cl"
#include "shapes/shapes.cl"

// On a CPU the first of W work-items works for all of them.
#define RAYS_TOGETHER (W > 1 && BRUME_TRIANGLES)

#if RAYS_TOGETHER
typedef struct {
  float origin[3][W], dir[3][W];
  Hit hit[W];
} RayLanes;

static inline float3 lane_vector(float v[3][W], int lane) { return (float3)(v[0][lane], v[1][lane], v[2][lane]); }

// t_max not above 0: nothing is looked for.
static inline void ray_lane_set(RayLanes* rays, int lane, float3 origin, float3 dir, float t_max) {
  rays->hit[lane].t = t_max;
  rays->origin[0][lane] = origin.x;
  rays->origin[1][lane] = origin.y;
  rays->origin[2][lane] = origin.z;
  rays->dir[0][lane] = dir.x;
  rays->dir[1][lane] = dir.y;
  rays->dir[2][lane] = dir.z;
}

static inline PacketHit packet_of_hits(const Hit* hits) {
  float t[W];
  int primitive[W];
  for (int i = 0; i < W; ++i) {
    t[i] = hits[i].t;
    primitive[i] = hits[i].primitive;
  }
  PacketHit packet;
  packet.t = lanes_load(t);
  packet.u = packet.v = (floatW)(0.0f);
  packet.primitive = LANES_GLUE(vload, BRUME_LANES)(0, primitive);
  return packet;
}

// Those lanes that met a triangle.
static inline void packet_to_hits(const PacketHit* packet, Hit* hits) {
  float t[W], u[W], v[W];
  int primitive[W];
  lanes_store(packet->t, t);
  lanes_store(packet->u, u);
  lanes_store(packet->v, v);
  LANES_GLUE(vstore, BRUME_LANES)(packet->primitive, 0, primitive);
  for (int i = 0; i < W; ++i) {
    if (primitive[i] < FIRST_TRIANGLE) continue;
    hits[i].t = t[i];
    hits[i].primitive = primitive[i];
    hits[i].u = u[i];
    hits[i].v = v[i];
  }
}

static inline RayPacket packet_of_rays(RayLanes* rays) {
  RayPacket packet;
  for (int axis = 0; axis < 3; ++axis) {
    packet.origin.v[axis] = lanes_load(rays->origin[axis]);
    packet.dir.v[axis] = lanes_load(rays->dir[axis]);
  }
  return packet;
}

#if BRUME_INSTANCES
// Nearest triangle of an instance of each ray; `any`: one by one.
static inline void rays_hit_instances(const Scene* scene, RayLanes* rays, int any) {
  if (any) {
    for (int i = 0; i < W; ++i)
      if (rays->hit[i].t > 0.0f && rays->hit[i].primitive == PRIMITIVE_NONE)
        instances_hit(scene, lane_vector(rays->origin, i), lane_vector(rays->dir, i), 1, &rays->hit[i]);
    return;
  }
  InstanceRays all;
  for (int i = 0; i < W; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      all.origin[axis][i] = rays->origin[axis][i];
      all.dir[axis][i] = rays->dir[axis][i];
    }
    const Hit hit = rays->hit[i];
    all.t[i] = hit.t;
    all.u[i] = hit.u;
    all.v[i] = hit.v;
    all.primitive[i] = hit.primitive;
    all.instance[i] = hit.instance;
  }
  const RayPacket packet = packet_of_rays(rays);
  const int done = instances_packet_hit(scene, &packet, &all);
  for (int i = 0; i < W; ++i) {
    Hit* hit = &rays->hit[i];
    if (all.instance[i] != INSTANCE_NONE) {
      hit->t = all.t[i];
      hit->u = all.u[i];
      hit->v = all.v[i];
      hit->primitive = all.primitive[i];
      hit->instance = all.instance[i];
    }
    if (!done) instances_hit(scene, lane_vector(rays->origin, i), lane_vector(rays->dir, i), 0, hit);
  }
}
#endif

static inline void rays_hit_triangles(const Scene* scene, RayLanes* rays, int any) {
  const RayPacket packet = packet_of_rays(rays);
  PacketHit found = packet_of_hits(rays->hit);
  if (packet_hit(scene, 0, &packet, any, &found)) {
    packet_to_hits(&found, rays->hit);
    return;
  }
  for (int i = 0; i < W; ++i)
    if (rays->hit[i].t > 0.0f)
      bvh_hit(scene, 0, lane_vector(rays->origin, i), lane_vector(rays->dir, i), any, &rays->hit[i]);
}

// Nearest surface with 0 < t < t_max of each ray; `any`: the first one found will do.
static inline void rays_hit(const Scene* scene, RayLanes* rays, int any) {
  for (int i = 0; i < W; ++i) {
    Hit* hit = &rays->hit[i];
    *hit = shapes_hit(scene, lane_vector(rays->origin, i), lane_vector(rays->dir, i), hit->t, any);
    if (any && hit->primitive != PRIMITIVE_NONE) hit->t = PACKET_DONE;
  }
  if (scene->frame->triangle_count > 0) rays_hit_triangles(scene, rays, any);
#if BRUME_INSTANCES
  if (scene->frame->instance_root >= 0) rays_hit_instances(scene, rays, any);
#endif
}
#endif

#endif
