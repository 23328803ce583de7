// Instances that W rays meet which go about the same way: the packet goes through the BVH over the instances. Of those
// whose box many rays meet, they go on through the mesh together, else one by one. A ray meets a triangle at the same
// bits as alone.
#ifndef BRUME_SHAPES_INSTANCE_PACKET_CL
#define BRUME_SHAPES_INSTANCE_PACKET_CL
#include "shapes/instances.cl"
#include "shapes/packet.cl"

#if BRUME_INSTANCES && W > 1

#define TOGETHER_LEAST (W / 4)  // so many rays are followed together rather than alone
#define TOGETHER_TRIED 3        // of so many instances
#define BOX_SLACK 0x1p-20f  // of the way to a plane through the origin: what rounding of those to both sides comes to

// 1 / direction and -origin / direction.
typedef struct {
  LaneVectors inverse, start;
  floatW slack;
} BoxRays;

static inline BoxRays box_rays(const RayPacket* rays) {
  BoxRays r;
  r.slack = (floatW)(0.0f);
  for (int k = 0; k < 3; ++k) {
    const floatW d = rays->dir.v[k];
    r.inverse.v[k] = 1.0f / lanes_select(d, copysign((floatW)(DIRECTION_LEAST), d), fabs(d) < DIRECTION_LEAST);
    r.start.v[k] = -rays->origin.v[k] * r.inverse.v[k];
    r.slack = fmax_ordered(r.slack, BOX_SLACK * fabs(r.start.v[k]));
  }
  return r;
}

// Which rays may meet what is in a box before t_max.
static inline intW rays_meet(const BoxRays* r, const float* lo, const float* hi, floatW t_max) {
  floatW enter = (floatW)(0.0f), leave = t_max;
  for (int k = 0; k < 3; ++k) {
    const floatW a = mad_exact((floatW)(lo[k]), r->inverse.v[k], r->start.v[k]);
    const floatW b = mad_exact((floatW)(hi[k]), r->inverse.v[k], r->start.v[k]);
    enter = fmax_ordered(enter, fmin_ordered(a, b));
    leave = fmin_ordered(leave, fmax_ordered(a, b) + r->slack);
  }
  return enter - r->slack <= leave;
}

// Some of the rays in the space of a mesh, the others beside one of those.
static inline RayPacket rays_in_mesh(const Affine* there, const RayLanes* rays, intW some, int one) {
  const float3 origin = affine_point(there, (float3)(rays->origin[0][one], rays->origin[1][one], rays->origin[2][one]));
  const float3 dir = affine_dir(there, (float3)(rays->dir[0][one], rays->dir[1][one], rays->dir[2][one]));
  const floatW ox = lanes_load(rays->origin[0]), oy = lanes_load(rays->origin[1]), oz = lanes_load(rays->origin[2]);
  const floatW dx = lanes_load(rays->dir[0]), dy = lanes_load(rays->dir[1]), dz = lanes_load(rays->dir[2]);
  RayPacket packet;
  for (int k = 0; k < 3; ++k) {  // the sums of affine_point and affine_dir
    const float* m = there->m + 4 * k;
    const floatW x = (floatW)(m[0]), y = (floatW)(m[1]), z = (floatW)(m[2]);
    const floatW o = mad_exact(x, ox, mad_exact(y, oy, mad_exact(z, oz, (floatW)(m[3]))));
    const floatW d = mad_exact(x, dx, mad_exact(y, dy, z * dz));
    packet.origin.v[k] = lanes_select((floatW)(vec_axis(origin, k)), o, some);
    packet.dir.v[k] = lanes_select((floatW)(vec_axis(dir, k)), d, some);
  }
  return packet;
}

static inline void ray_instance_hit(const Scene* scene, int index, RayLanes* rays, int i) {
  Hit hit = ray_lane_hit(rays, i);
  instance_hit(scene, index, lane_vector(rays->origin, i), lane_vector(rays->dir, i), 0, &hit);
  ray_lane_hits(rays, i, &hit);
}

// instance_hit of some of W rays at once; 0, and nothing done, where they do not go about the same way.
static inline int instance_packet_hit(const Scene* scene, int index, const RayPacket* in_mesh, intW some,
                                      RayLanes* rays) {
  const intW instance = lanes_load(rays->instance), primitive = lanes_load(rays->primitive);
  const intW none = select((intW)(PRIMITIVE_NONE), (intW)(INT_MAX), (intW)(index) < instance);
  const floatW t = lanes_load(rays->t), u = lanes_load(rays->u), v = lanes_load(rays->v);
  PacketHit found;
  found.t = lanes_select((floatW)(0.0f), t, some);  // the others meet nothing
  found.u = u;
  found.v = v;
  found.primitive = none;
  if (!packet_hit(scene, scene->instances[index].root, in_mesh, 0, &found)) return 0;
  const intW met = some & (found.primitive != none);
  lanes_store(lanes_select(t, found.t, met), rays->t);
  lanes_store(found.u, rays->u);
  lanes_store(found.v, rays->v);
  lanes_store(select(primitive, found.primitive, met), rays->primitive);
  lanes_store(select(instance, (intW)(index), met), rays->instance);
  return 1;
}

// How many of the rays may meet the instance.
static inline int rays_instance_hit(const Scene* scene, int index, const BoxRays* boxes, RayLanes* rays) {
  const float lo[3] = {scene->instances[index].lo.x, scene->instances[index].lo.y, scene->instances[index].lo.z};
  const float hi[3] = {scene->instances[index].hi.x, scene->instances[index].hi.y, scene->instances[index].hi.z};
  const intW some = rays_meet(boxes, lo, hi, lanes_load(rays->t));
  int meets[W], count = 0, one = 0;
  lanes_store(some, meets);
  for (int i = 0; i < W; ++i) {
    if (!meets[i]) continue;
    ++count;
    one = i;
  }
  if (count == 0) return 0;
  if (count > TOGETHER_LEAST) {
    const Affine there = scene->instances[index].mesh_from_world;
    const RayPacket in_mesh = rays_in_mesh(&there, rays, some, one);
    if (instance_packet_hit(scene, index, &in_mesh, some, rays)) return count;
  }
  for (int i = 0; i < W; ++i)
    if (meets[i]) ray_instance_hit(scene, index, rays, i);
  return count;
}

// instances_hit of W rays; 0, and not all done, where they do not go about the same way, or mostly few of them meet an
// instance: small ones far away are better sought ray by ray.
static inline int instances_packet_hit(const Scene* scene, const RayPacket* packet, RayLanes* rays) {
  PacketBox box;
  if (!packet_box(packet, &box)) return 0;
  const BoxRays boxes = box_rays(packet);
  float t_max = lanes_most(lanes_load(rays->t));
  BvhEntry stack[BVH_STACK];
  int top = 0, link = scene->frame->instance_root, seen = 0, met = 0;
  while (link != BVH_ABSENT) {
    if (link >= 0) {
      link = packet_open(scene, &box, link, t_max, stack, &top);
      if (link != BVH_ABSENT) continue;
    } else {
      met += rays_instance_hit(scene, ~link, &boxes, rays);
      if (++seen >= TOGETHER_TRIED && met <= seen * TOGETHER_LEAST) return 0;
      t_max = lanes_most(lanes_load(rays->t));
    }
    link = bvh_pop(stack, &top, t_max);
  }
  return 1;
}

#endif
#endif
