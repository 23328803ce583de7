// Meshes that are held once and stand in several places: a BVH over the boxes of their instances, and below each of its
// leaves that of the mesh, for the ray taken to the space of the mesh [Wald03].
#ifndef BRUME_SHAPES_INSTANCES_CL
#define BRUME_SHAPES_INSTANCES_CL
#include "shapes/bvh.cl"

#if BRUME_INSTANCES
// dir keeps the length that it gets, so that distances are those of the world. Equal ones go to what stands in the
// world, then to the lower instance, whatever the order of visits.
static inline void instance_hit(const Scene* scene, int index, float3 origin, float3 dir, int any, Hit* hit) {
  const Affine there = scene->instances[index].mesh_from_world;
  const int none = index < hit->instance ? INT_MAX : PRIMITIVE_NONE;
  Hit found = *hit;
  found.primitive = none;
  bvh_hit(scene, scene->instances[index].root, affine_point(&there, origin), affine_dir(&there, dir), any, &found);
  if (found.primitive == none) return;
  found.instance = index;
  *hit = found;
}

// Nearest triangle of an instance with 0 < t < hit->t; `any`: stop at the first one.
static inline void instances_hit(const Scene* scene, float3 origin, float3 dir, int any, Hit* hit) {
  const BoxRay box = box_ray(origin, dir);
  BvhEntry stack[BVH_STACK];
  int top = 0, link = scene->frame->instance_root;
  while (link != BVH_ABSENT) {
    if (link >= 0) {
      link = bvh_open(scene, &box, link, hit->t, stack, &top);
      if (link != BVH_ABSENT) continue;
    } else {
      instance_hit(scene, ~link, origin, dir, any, hit);
      if (any && hit->instance != INSTANCE_NONE) return;
    }
    link = bvh_pop(stack, &top, hit->t);
  }
}

// A normal of the mesh, of any length, in the world: by the transpose of the way there, which keeps it outside of a
// mesh that is mirrored.
static inline float3 instance_normal(const Instance* instance, float3 n) {
  return vec_unit(affine_normal(&instance->mesh_from_world, n));
}
#endif

// A triangle that was hit, in the world; *geometric: its unit normal.
static inline Triangle triangle_of(const Scene* scene, int primitive, int instance, float3* geometric) {
  Triangle t = scene->triangles[primitive - FIRST_TRIANGLE];
  const float3 p0 = vec_unpack(t.p[0]);
  *geometric = vec_unit(cross(vec_scaled(vec_unpack(t.p[1]) - p0), vec_scaled(vec_unpack(t.p[2]) - p0)));
#if BRUME_INSTANCES
  if (instance == INSTANCE_NONE) return t;
  const Instance at = scene->instances[instance];
  *geometric = instance_normal(&at, *geometric);
  for (int k = 0; k < 3; ++k) {
    t.p[k] = vec_pack(affine_point(&at.world_from_mesh, vec_unpack(t.p[k])));
    if (t.shading != TRIANGLE_FLAT) t.n[k] = vec_pack(instance_normal(&at, vec_unpack(t.n[k])));
  }
  if (at.material >= 0) t.material = at.material;
#endif
  return t;
}

#endif
