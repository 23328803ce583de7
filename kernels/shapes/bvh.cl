// Ordered traversal of the wide BVH (layout: shared/bvh.h): the boxes of a node are tested at once, nearer children
// first.
#ifndef BRUME_SHAPES_BVH_CL
#define BRUME_SHAPES_BVH_CL
#include "lib/scene.cl"
#include "shapes/triangle.cl"

// Of the planes that a ray meets first and last: 1 / direction, -origin / direction, and where in a node they are.
typedef struct {
  float3 near, near_start, far, far_start;
  size_t near_x, near_y, near_z, far_x, far_y, far_z;
} BoxRay;

// A zero component becomes tiny instead: the slab then either contains the ray for all t that matter or for none,
// without NaN.
#define DIRECTION_LEAST 1e-18f
static inline float safe_inverse(float d) {
  return 1.0f / (fabs(d) < DIRECTION_LEAST ? copysign(DIRECTION_LEAST, d) : d);
}

// plane / d - origin / d is off by the roundings of both quotients, 2 γ(2) of the larger one, which is the other or t;
// boxes are entered earlier and left later by that of the other, and earlier by twice that of t [Ize13].
static inline BoxRay box_ray_between(float3 near_origin, float3 far_origin, float3 inverse) {
  BoxRay r;
  r.far = inverse;
  r.near = inverse * (1.0f - 0x1p-20f);
  r.near_start = -near_origin * r.near - 0x1p-21f * fabs(near_origin * inverse);
  r.far_start = -far_origin * inverse + 0x1p-21f * fabs(far_origin * inverse);
  r.near_x = (inverse.x < 0.0f ? 3 : 0) * BRUME_BVH_WIDTH;
  r.near_y = (inverse.y < 0.0f ? 4 : 1) * BRUME_BVH_WIDTH;
  r.near_z = (inverse.z < 0.0f ? 5 : 2) * BRUME_BVH_WIDTH;
  r.far_x = 3 * BRUME_BVH_WIDTH - r.near_x;
  r.far_y = 5 * BRUME_BVH_WIDTH - r.near_y;
  r.far_z = 7 * BRUME_BVH_WIDTH - r.near_z;
  return r;
}

static inline BoxRay box_ray(float3 origin, float3 dir) {
  return box_ray_between(origin, origin, (float3)(safe_inverse(dir.x), safe_inverse(dir.y), safe_inverse(dir.z)));
}

// Which of the boxes of a group are hit before t_max, and where they are entered.
#define BOX_PLANE(r, plane, side, axis) mad_exact(plane, (BvhLanes)((r)->side.axis), (BvhLanes)((r)->side##_start.axis))
static inline BvhMask box_hits(const BoxRay* r, __global const float* node, float t_max, BvhLanes* enter) {
#define PLANE(side, axis) BOX_PLANE(r, bvh_load(node + r->side##_##axis), side, axis)
  const BvhLanes first = fmax_ordered(PLANE(near, x), PLANE(near, y));
  const BvhLanes last = fmin_ordered(PLANE(far, x), PLANE(far, y));
  *enter = fmax_ordered(first, fmax_ordered(PLANE(near, z), (BvhLanes)(0.0f)));
  return bvh_mask(*enter <= fmin_ordered(last, fmin_ordered(PLANE(far, z), (BvhLanes)(t_max))));
#undef PLANE
}

// Before what goes through a tree: with instances several places ask for that, else inlined it is some per cent
// quicker.
#if BRUME_INSTANCES
#define BVH_CALLED OUTLINED
#else
#define BVH_CALLED static inline
#endif

typedef struct {
  float t;
  int link;
} BvhEntry;

// Of those children of a group that are hit, and *nearest, the nearest; the others wait on the stack.
static inline void bvh_stack(BvhMask mask, BvhLanes enter, __global const int* links, BvhEntry* nearest,
                             BvhEntry* stack, int* top) {
  if (mask == 0) return;
  float t[BVH_LANES];
  bvh_store(enter, t);
  for (; mask != 0; mask &= mask - 1) {
    const int lane = bvh_lowest(mask);
    BvhEntry entry = {t[lane], links[lane]};
    if (nearest->link == BVH_ABSENT) {
      *nearest = entry;
      continue;
    }
    if (entry.t < nearest->t) {
      const BvhEntry before = *nearest;
      *nearest = entry;
      entry = before;
    }
    stack[(*top)++] = entry;
  }
}

// The nearest hit child of a node, BVH_ABSENT for none; the others wait on the stack.
static inline int bvh_open(const Scene* scene, const BoxRay* box, int node, float t_max, BvhEntry* stack, int* top) {
  __global const float* boxes = scene->bvh_nodes + (size_t)node * BVH_NODE_FLOATS(BRUME_BVH_WIDTH);
  __global const int* links = (__global const int*)(boxes + 6 * BRUME_BVH_WIDTH);
  BvhEntry nearest = {INFINITY, BVH_ABSENT};
  for (int group = 0; group < BRUME_BVH_WIDTH; group += BVH_LANES) {
    BvhLanes enter;
    const BvhMask mask = box_hits(box, boxes + group, t_max, &enter);
    bvh_stack(mask, enter, links + group, &nearest, stack, top);
  }
  return nearest.link;
}

// What waits on the stack no farther than t_max; BVH_ABSENT where nothing does.
static inline int bvh_pop(const BvhEntry* stack, int* top, float t_max) {
  while (*top > 0)
    if (!(stack[--*top].t > t_max)) return stack[*top].link;
  return BVH_ABSENT;
}

// Nearest triangle in the blocks of a leaf. Equal distances go to the lower index, whatever the order of visits.
static inline void leaf_hit(const Scene* scene, const ShearedRay* ray, int link, Hit* hit) {
  const int first = (~link) >> 4, count = (~link) & 15;
  for (int block = first; block < first + count; ++block) {
    __global const float* corners = scene->bvh_blocks + (size_t)block * BVH_BLOCK_FLOATS(BRUME_BVH_WIDTH);
    __global const int* ids = (__global const int*)(corners + 9 * BRUME_BVH_WIDTH);
    for (int group = 0; group < BRUME_BVH_WIDTH; group += BVH_LANES) {
      TriangleHits hits;
      BvhMask mask = triangle_hits(ray, corners + group, hit->t, &hits);
      if (mask == 0) continue;
      float t[BVH_LANES], u[BVH_LANES], v[BVH_LANES];
      bvh_store(hits.t, t);
      bvh_store(hits.u, u);
      bvh_store(hits.v, v);
      for (; mask != 0; mask &= mask - 1) {
        const int lane = bvh_lowest(mask), primitive = FIRST_TRIANGLE + ids[group + lane];
        if (t[lane] > hit->t || (t[lane] == hit->t && primitive >= hit->primitive)) continue;
        hit->t = t[lane];
        hit->primitive = primitive;
        hit->u = u[lane];
        hit->v = v[lane];
      }
    }
  }
}

// Nearest triangle below node `root` with 0 < t < hit->t; `any`: stop at the first one. dir may have any length.
BVH_CALLED void bvh_hit(const Scene* scene, int root, float3 origin, float3 dir, int any, Hit* hit) {
  const BoxRay box = box_ray(origin, dir);
  const ShearedRay ray = ray_shear(origin, dir);
  const float t_limit = hit->t;
  BvhEntry stack[BVH_STACK];
  int top = 0, link = root;
  while (link != BVH_ABSENT) {
    if (link >= 0) {
      link = bvh_open(scene, &box, link, hit->t, stack, &top);
      if (link != BVH_ABSENT) continue;
    } else {
      leaf_hit(scene, &ray, link, hit);
      if (any && hit->t < t_limit) return;
    }
    link = bvh_pop(stack, &top, hit->t);
  }
}

#endif
