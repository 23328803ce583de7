// Ordered traversal of the wide BVH (layout: shared/bvh.h): a node's boxes are tested W at a time, nearer children
// first.
#ifndef BRUME_SHAPES_BVH_CL
#define BRUME_SHAPES_BVH_CL
#include "lib/scene.cl"
#include "shapes/triangle.cl"

typedef struct {
  float3 inv_d, origin;
  int near_x, near_y, near_z;  // which of the 6 runs of a node holds the plane that the ray meets first
  int far_x, far_y, far_z;
} BoxRay;

// A zero component becomes tiny instead: the slab then either contains the ray for all t that matter or for none,
// without NaN.
static inline float safe_inverse(float d) { return 1.0f / (fabs(d) < 1e-18f ? copysign(1e-18f, d) : d); }

static inline BoxRay box_ray(float3 origin, float3 dir) {
  BoxRay r;
  r.inv_d = (float3)(safe_inverse(dir.x), safe_inverse(dir.y), safe_inverse(dir.z));
  r.origin = origin;
  r.near_x = r.inv_d.x < 0.0f ? 3 : 0;
  r.near_y = r.inv_d.y < 0.0f ? 4 : 1;
  r.near_z = r.inv_d.z < 0.0f ? 5 : 2;
  r.far_x = 3 - r.near_x;
  r.far_y = 5 - r.near_y;
  r.far_z = 7 - r.near_z;
  return r;
}

// Entry distances of W boxes; INFINITY for a miss. The far side is widened by 2 γ(3) [Ize13].
static inline floatW box_hits(const BoxRay* r, __global const float* node, float t_max) {
#define PLANE(run) lanes_load(node + (run)*BRUME_BVH_WIDTH)
  const floatW x0 = (PLANE(r->near_x) - r->origin.x) * r->inv_d.x, x1 = (PLANE(r->far_x) - r->origin.x) * r->inv_d.x;
  const floatW y0 = (PLANE(r->near_y) - r->origin.y) * r->inv_d.y, y1 = (PLANE(r->far_y) - r->origin.y) * r->inv_d.y;
  const floatW z0 = (PLANE(r->near_z) - r->origin.z) * r->inv_d.z, z1 = (PLANE(r->far_z) - r->origin.z) * r->inv_d.z;
#undef PLANE
  const floatW t0 = fmax(fmax(x0, y0), fmax(z0, (floatW)(0.0f)));
  const floatW t1 = fmin(fmin(x1, y1), fmin(z1, (floatW)(t_max))) * 1.0000004f;
  return lanes_select((floatW)(INFINITY), t0, t0 <= t1);
}

typedef struct {
  float t;
  int link;
} BvhEntry;

// Puts the hit children of a node on the stack, the nearest on top.
static inline int bvh_push_children(const Scene* scene, const BoxRay* box, int node, float t_max, BvhEntry* stack,
                                    int top) {
  const int first = top;
  for (int group = 0; group < BRUME_BVH_WIDTH; group += W) {
    float t[W];
    lanes_store(box_hits(box, scene->bvh_nodes + (size_t)node * (6 * BRUME_BVH_WIDTH) + group, t_max), t);
    for (int lane = 0; lane < W; ++lane) {
      if (!(t[lane] < INFINITY)) continue;
      int slot = top++;
      for (; slot > first && stack[slot - 1].t < t[lane]; --slot) stack[slot] = stack[slot - 1];
      stack[slot].t = t[lane];
      stack[slot].link = scene->bvh_links[node * BRUME_BVH_WIDTH + group + lane];
    }
  }
  return top;
}

// Nearest triangle in the blocks of a leaf. Equal distances go to the lower index, whatever the order of visits.
static inline void leaf_hit(const Scene* scene, const ShearedRay* ray, int link, Hit* hit) {
  const int first = (~link) >> 4, count = (~link) & 15;
  for (int block = first; block < first + count; ++block) {
    for (int group = 0; group < BRUME_BVH_WIDTH; group += W) {
      const TriangleHits hits =
          triangle_hits(ray, scene->bvh_blocks + (size_t)block * (9 * BRUME_BVH_WIDTH) + group, hit->t);
      if (!lanes_any(hits.t < (floatW)(INFINITY))) continue;
      float t[W], u[W], v[W];
      lanes_store(hits.t, t);
      lanes_store(hits.u, u);
      lanes_store(hits.v, v);
      for (int lane = 0; lane < W; ++lane) {
        const int primitive = FIRST_TRIANGLE + scene->bvh_ids[block * BRUME_BVH_WIDTH + group + lane];
        if (!(t[lane] < hit->t || (t[lane] == hit->t && t[lane] < INFINITY && primitive < hit->primitive))) continue;
        hit->t = t[lane];
        hit->primitive = primitive;
        hit->u = u[lane];
        hit->v = v[lane];
      }
    }
  }
}

// Nearest triangle below node `root` with 0 < t < hit->t; `any`: stop at the first one. dir may have any length.
static inline void bvh_hit(const Scene* scene, int root, float3 origin, float3 dir, int any, Hit* hit) {
  const BoxRay box = box_ray(origin, dir);
  const ShearedRay ray = ray_shear(origin, dir);
  const float t_limit = hit->t;
  BvhEntry stack[BVH_STACK];
  int top = bvh_push_children(scene, &box, root, hit->t, stack, 0);
  while (top > 0) {
    const BvhEntry entry = stack[--top];
    if (entry.t > hit->t) continue;
    if (entry.link >= 0) {
      top = bvh_push_children(scene, &box, entry.link, hit->t, stack, top);
    } else {
      leaf_hit(scene, &ray, entry.link, hit);
      if (any && hit->t < t_limit) return;
    }
  }
}

#endif
