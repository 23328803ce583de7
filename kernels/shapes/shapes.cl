// The dispatcher over shapes: nearest hit, any hit, and what the surface is at a hit.
#ifndef BRUME_SHAPES_SHAPES_CL
#define BRUME_SHAPES_SHAPES_CL
#include "lib/scene.cl"
#include "shapes/box.cl"
#include "shapes/cylinder.cl"
#include "shapes/instances.cl"
#include "shapes/isosurface.cl"
#include "shapes/plane.cl"
#include "shapes/quad.cl"
#include "shapes/sphere.cl"

// Whether there is anything that blocks.
static inline int scene_has_surfaces(const Scene* scene) {
  const __constant Frame* frame = scene->frame;
  return HAS_SURFACES &&
         (frame->list_count > 0 || frame->shape_root >= 0 || frame->triangle_count > 0 || frame->instance_root >= 0);
}

#define PLANE_MARGIN 0x1p-5f  // of the distance to a plane: how far before it a ray starts

// t of the nearest hit with t > 0 of one closed form; INFINITY for a miss. A row without its function does not compile.
static inline float shape_hit(const Shape* shape, float3 origin, float3 dir) {
#define ROW(id, name, help) \
  if (USES_SHAPE(id) && shape->type == SHAPE_##id) return name##_hit(shape, origin, dir);
  BRUME_CLOSED_FORMS(ROW)
#undef ROW
  return INFINITY;
}

// Outward unit normal of the surface to which the point is nearest, and its uv where it is textured.
static inline float3 shape_normal(const Shape* shape, float3 point, int textured, float2* uv) {
#define ROW(id, name, help) \
  if (USES_SHAPE(id) && shape->type == SHAPE_##id) return name##_normal(shape, point, textured, uv);
  BRUME_CLOSED_FORMS(ROW)
#undef ROW
  return (float3)(0.0f, 0.0f, 1.0f);
}

// Which place of a shape that emits the point asks, by two numbers in [0, 1).
static inline ShapePlace shape_emit(const Shape* shape, float3 from, float2 xi) {
#define ROW(id, name, help) \
  if (USES_SHAPE(id) && shape->type == SHAPE_##id) return name##_emit(shape, from, xi);
  BRUME_CLOSED_FORMS(ROW)
#undef ROW
  return shape_place_of((float3)(0.0f), (float3)(0.0f), 0.0f);
}

// The shape, where it is hit with 0 < t < hit->t. Equal distances go to the lower index, whatever the order of visits.
static inline void shape_try(const Scene* scene, int index, float3 origin, float3 dir, Hit* hit) {
  const Shape shape = scene->shapes[index];
  if (USES_SHAPE(ISOSURFACE) && shape.type == SHAPE_ISOSURFACE) {
    isosurface_hit(scene, &shape, index, origin, dir, hit);
    return;
  }
  const float t = shape_hit(&shape, origin, dir);
  if (!(t < hit->t || (t == hit->t && index < hit->primitive))) return;
  hit->t = t;
  hit->primitive = index;
  hit->u = hit->v = 0.0f;  // maybe those of an isosurface behind
}

// Which shapes a ray may hit: those behind the BVH, nearer ones first, then those of the list.
typedef struct {
#if BRUME_SHAPE_BVH
  BoxRay box;
  BvhEntry stack[BVH_STACK];
  int top, link;
#endif
  int listed;
} ShapeWalk;

static inline void shapes_begin(const Scene* scene, float3 origin, float3 dir, ShapeWalk* walk) {
#if BRUME_SHAPE_BVH
  walk->box = box_ray(origin, dir);
  walk->top = 0;
  walk->link = scene->frame->shape_root < 0 ? BVH_ABSENT : scene->frame->shape_root;
#endif
  walk->listed = 0;
}

// The next of them before t_max, or -1.
static inline int shapes_next(const Scene* scene, float t_max, ShapeWalk* walk) {
#if BRUME_SHAPE_BVH
  for (;;) {
    const int link = walk->link == BVH_ABSENT ? bvh_pop(walk->stack, &walk->top, t_max) : walk->link;
    walk->link = BVH_ABSENT;
    if (link == BVH_ABSENT) break;
    if (link < 0) return ~link;
    walk->link = bvh_open(scene, &walk->box, link, t_max, walk->stack, &walk->top);
  }
#endif
  return walk->listed < scene->frame->list_count ? scene->shape_list[walk->listed++] : -1;
}

// Nearest shape but triangles with 0 < t < t_max; `any`: the first one found will do.
static inline Hit shapes_hit(const Scene* scene, float3 origin, float3 dir, float t_max, int any) {
  Hit hit;
  hit.t = t_max;
  hit.primitive = PRIMITIVE_NONE;
  hit.u = 0.0f;
  hit.v = 0.0f;
  hit.instance = INSTANCE_NONE;
  hit.in_media = 0;
#if BRUME_SHAPES_USED
  ShapeWalk walk;
  shapes_begin(scene, origin, dir, &walk);
  for (int i = shapes_next(scene, t_max, &walk); i >= 0; i = shapes_next(scene, hit.t, &walk)) {
    shape_try(scene, i, origin, dir, &hit);
    if (any && hit.primitive != PRIMITIVE_NONE) return hit;
  }
#endif
  return hit;
}

// Nearest surface with 0 < t < t_max; `any`: the first one found will do.
static inline Hit scene_hit(const Scene* scene, float3 origin, float3 dir, float t_max, int any) {
  Hit hit = shapes_hit(scene, origin, dir, t_max, any);
#if BRUME_TRIANGLES
  if (any && hit.primitive != PRIMITIVE_NONE) return hit;
  if (scene->frame->triangle_count > 0) bvh_hit(scene, 0, origin, dir, any, &hit);
#endif
#if BRUME_INSTANCES
  if (any && hit.primitive != PRIMITIVE_NONE) return hit;
  if (scene->frame->instance_root >= 0) instances_hit(scene, origin, dir, any, &hit);
#endif
  return hit;
}

// A camera ray that starts at the scene's bounds may have passed a plane on its way there, which has no bounds: back to
// before it.
static inline void ray_start_before_planes(const Scene* scene, Ray* ray) {
  if (!USES_SHAPE(PLANE)) return;
  const float3 origin = vec_unpack(ray->origin), dir = vec_unpack(ray->dir);
  float t = 0.0f;
  for (int i = 0; i < scene->frame->list_count; ++i) {
    const Shape shape = scene->shapes[scene->shape_list[i]];
    if (shape.type != SHAPE_PLANE) continue;
    const float3 normal = shape_vec(&shape, 3);
    const float back = dot(normal, origin - shape_vec(&shape, 0)) / dot(normal, dir);  // not finite: beside the plane
    if (back >= 0.0f && back < ray->start) t = fmin(t, -fmin(ray->start, back + PLANE_MARGIN * fmax(1.0f, back)));
  }
  ray->origin = vec_pack(vec_point(origin, dir, t));
  ray->start += t;
}

static inline int scene_occluded(const Scene* scene, float3 origin, float3 dir, float t_max) {
#if HAS_SURFACES
  return scene_hit(scene, origin, dir, t_max, 1).primitive != PRIMITIVE_NONE;
#else
  return 0;
#endif
}

#endif
