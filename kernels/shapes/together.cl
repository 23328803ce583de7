// scene_hit of W rays at once: the same bits (of `any`, the same answer), sooner: closed forms in any case, triangles
// where the rays go about the same way.
#ifndef BRUME_SHAPES_TOGETHER_CL
#define BRUME_SHAPES_TOGETHER_CL
#include "shapes/forms_together.cl"
#include "shapes/instance_packet.cl"
#include "shapes/shapes.cl"

// On a CPU the first of W work-items works for all of them.
#define RAYS_TOGETHER (W > 1 && HAS_SURFACES)

#if RAYS_TOGETHER
#if BRUME_SHAPES_USED
// The closed forms of the list, each against all rays.
static inline void rays_hit_forms(const Scene* scene, RayLanes* rays, int any) {
  const RayPacket packet = packet_of_rays(rays);
  PacketHit found = packet_of_hits(rays);
  for (int n = 0; n < scene->frame->list_count; ++n) {
    const int index = scene->shape_list[n];
    const Shape shape = scene->shapes[index];
    if (USES_SHAPE(ISOSURFACE) && shape.type == SHAPE_ISOSURFACE) continue;
    const floatW t = shape_hit_lanes(&shape, &packet);
    const intW nearer = (t < found.t) | ((t == found.t) & (index < found.primitive));
    found.t = lanes_select(found.t, any ? (floatW)(PACKET_DONE) : t, nearer);
    found.primitive = select(found.primitive, (intW)(index), nearer);
  }
  packet_to_hits(&found, rays);
}

// What a ray tries by itself: all shapes where there is a tree over them, else isosurfaces.
static inline void ray_hit_others(const Scene* scene, RayLanes* rays, int lane, int any) {
  if (!(rays->t[lane] > 0.0f)) return;
  const float3 origin = lane_vector(rays->origin, lane), dir = lane_vector(rays->dir, lane);
  Hit hit = ray_lane_hit(rays, lane);
#if BRUME_SHAPE_BVH
  if (scene->frame->shape_root >= 0) hit = shapes_hit(scene, origin, dir, hit.t, any);
#endif
  for (int n = 0;
       USES_SHAPE(ISOSURFACE) && (!BRUME_SHAPE_BVH || scene->frame->shape_root < 0) && n < scene->frame->list_count;
       ++n) {
    const int index = scene->shape_list[n];
    const Shape shape = scene->shapes[index];
    if (shape.type == SHAPE_ISOSURFACE) isosurface_hit(scene, &shape, index, origin, dir, &hit);
  }
  if (any && hit.primitive != PRIMITIVE_NONE) hit.t = PACKET_DONE;
  ray_lane_hits(rays, lane, &hit);
}

static inline void rays_hit_shapes(const Scene* scene, RayLanes* rays, int any) {
  if (!BRUME_SHAPE_BVH || scene->frame->shape_root < 0) rays_hit_forms(scene, rays, any);
  if (!BRUME_SHAPE_BVH && !USES_SHAPE(ISOSURFACE)) return;
  for (int i = 0; i < W; ++i) ray_hit_others(scene, rays, i, any);
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
