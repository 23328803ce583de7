// scene_hit of W rays at once: the same bits (of `any`, the same answer), sooner: closed forms in any case, triangles
// where the rays go about the same way.
#ifndef BRUME_SHAPES_TOGETHER_CL
#define BRUME_SHAPES_TOGETHER_CL
#include "shapes/forms_together.cl"
#include "shapes/instance_packet.cl"
#include "shapes/isosurface_together.cl"
#include "shapes/shapes.cl"

// On a CPU the first of W work-items works for all of them.
#define RAYS_TOGETHER (W > 1 && HAS_SURFACES)

#if RAYS_TOGETHER
#if BRUME_SHAPES_USED
// The shapes of the list, each against all rays: first closed forms, which may end a way before the water.
static inline void rays_hit_list(const Scene* scene, RayLanes* rays, int any) {
  const RayPacket packet = packet_of_rays(rays);
  PacketHit found = packet_of_hits(rays);
  for (int last = 0; last <= USES_SHAPE(ISOSURFACE); ++last)
    for (int n = 0; n < scene->frame->list_count; ++n) {
      const int index = scene->shape_list[n];
      const Shape shape = scene->shapes[index];
      if (USES_SHAPE(ISOSURFACE) && (shape.type == SHAPE_ISOSURFACE) != last) continue;
      if (USES_SHAPE(ISOSURFACE) && last) {
        isosurface_hits(scene, &shape, index, &packet, &found);
      } else {
        const floatW t = shape_hit_lanes(&shape, &packet);
        const intW nearer = (t < found.t) | ((t == found.t) & (index < found.primitive));
        found.t = lanes_select(found.t, t, nearer);
        found.primitive = select(found.primitive, (intW)(index), nearer);
      }
      if (any) found.t = lanes_select(found.t, (floatW)(PACKET_DONE), found.primitive != PRIMITIVE_NONE);
    }
  packet_to_hits(&found, rays);
}

static inline void rays_hit_shapes(const Scene* scene, RayLanes* rays, int any) {
#if BRUME_SHAPE_BVH
  for (int i = 0; scene->frame->shape_root >= 0 && i < W; ++i) {
    Hit hit = shapes_hit(scene, lane_vector(rays->origin, i), lane_vector(rays->dir, i), rays->t[i], any);
    if (any && hit.primitive != PRIMITIVE_NONE) hit.t = PACKET_DONE;
    ray_lane_hits(rays, i, &hit);
  }
  if (scene->frame->shape_root >= 0) return;
#endif
  rays_hit_list(scene, rays, any);
}
#endif

#if BRUME_INSTANCES
// Nearest triangle of an instance of each ray; `any`: one by one.
static inline void rays_hit_instances(const Scene* scene, RayLanes* rays, int any) {
  const RayPacket packet = packet_of_rays(rays);
  if (!any && instances_packet_hit(scene, &packet, rays)) return;
  for (int i = 0; i < W; ++i) {
    if (any && !(rays->t[i] > 0.0f && rays->primitive[i] == PRIMITIVE_NONE)) continue;
    Hit hit = ray_lane_hit(rays, i);
    instances_hit(scene, lane_vector(rays->origin, i), lane_vector(rays->dir, i), any, &hit);
    ray_lane_hits(rays, i, &hit);
  }
}
#endif

#if BRUME_TRIANGLES
static inline void rays_hit_triangles(const Scene* scene, RayLanes* rays, int any) {
  const RayPacket packet = packet_of_rays(rays);
  PacketHit found = packet_of_hits(rays);
  if (packet_hit(scene, 0, &packet, any, &found)) {
    packet_to_hits(&found, rays);
    return;
  }
  for (int i = 0; i < W; ++i) {
    if (!(rays->t[i] > 0.0f)) continue;
    Hit hit = ray_lane_hit(rays, i);
    bvh_hit(scene, 0, lane_vector(rays->origin, i), lane_vector(rays->dir, i), any, &hit);
    ray_lane_hits(rays, i, &hit);
  }
}
#endif

// Nearest surface with 0 < t < t_max of each ray; `any`: the first one found will do.
static inline void rays_hit(const Scene* scene, RayLanes* rays, int any) {
  rays_hit_nothing(rays);
#if BRUME_SHAPES_USED
  rays_hit_shapes(scene, rays, any);
#endif
#if BRUME_TRIANGLES
  if (scene->frame->triangle_count > 0) rays_hit_triangles(scene, rays, any);
#endif
#if BRUME_INSTANCES
  if (scene->frame->instance_root >= 0) rays_hit_instances(scene, rays, any);
#endif
}
#endif

#endif
