// Axis-aligned unit cube under an affine map.
#ifndef BRUME_SHAPES_BOX_CL
#define BRUME_SHAPES_BOX_CL
#include "lib/slab.cl"
#include "shapes/shape.cl"

// Hit of the unit cube in its own space; t is the world's because the map is affine.
static inline float box_hit(const Shape* shape, float3 origin, float3 dir) {
  const Affine unit_from_world = shape_affine(shape);
  const float3 o = affine_point(&unit_from_world, origin), d = affine_dir(&unit_from_world, dir);
  float t0 = -INFINITY, t1 = INFINITY;
  if (!box_cut((float3)(0.0f), (float3)(1.0f), o, d, &t0, &t1)) return INFINITY;
  return t0 > 0.0f ? t0 : (t1 > 0.0f ? t1 : INFINITY);
}

// Outward normal and uv of the face to which the point is nearest.
static inline float3 box_normal(const Shape* shape, float3 point, int textured, float2* uv) {
  const Affine a = shape_affine(shape);
  const float3 p = affine_point(&a, point);
  const float3 d =
      (float3)(fmin(fabs(p.x), fabs(1.0f - p.x)), fmin(fabs(p.y), fabs(1.0f - p.y)), fmin(fabs(p.z), fabs(1.0f - p.z)));
  if (d.x <= d.y && d.x <= d.z) {
    if (textured) *uv = p.yz;
    return vec_unit((float3)(a.m[0], a.m[1], a.m[2])) * (p.x < 0.5f ? -1.0f : 1.0f);
  }
  if (d.y <= d.z) {
    if (textured) *uv = p.xz;
    return vec_unit((float3)(a.m[4], a.m[5], a.m[6])) * (p.y < 0.5f ? -1.0f : 1.0f);
  }
  if (textured) *uv = p.xy;
  return vec_unit((float3)(a.m[8], a.m[9], a.m[10])) * (p.z < 0.5f ? -1.0f : 1.0f);
}

// Of the faces whose outside is seen; from inside of all.
static inline ShapePlace box_emit(const Shape* shape, float3 from, float2 xi) {
  const Affine a = shape_affine(shape);
  const float3 p = affine_point(&a, from);
  const float3 rows[3] = {(float3)(a.m[0], a.m[1], a.m[2]), (float3)(a.m[4], a.m[5], a.m[6]),
                          (float3)(a.m[8], a.m[9], a.m[10])};
  const float volume = 1.0f / dot(rows[0], cross(rows[1], rows[2]));
  float3 edges[3];  // of the box, in the world
  for (int i = 0; i < 3; ++i) edges[i] = cross(rows[(i + 1) % 3], rows[(i + 2) % 3]) * volume;
  const float at[3] = {p.x, p.y, p.z};
  const int inside = vec_min(p) >= 0.0f && vec_max(p) <= 1.0f;
  float area[6], total = 0.0f;
  for (int i = 0; i < 6; ++i) {
    const int axis = i >> 1, seen = inside || (i & 1 ? at[axis] > 1.0f : at[axis] < 0.0f);
    area[i] = seen ? length(cross(edges[(axis + 1) % 3], edges[(axis + 2) % 3])) : 0.0f;
    total += area[i];
  }
  float left = xi.x * total;
  int face = 0;
  for (; face < 5 && !(left < area[face]); ++face) left -= area[face];
  const int axis = face >> 1, b = (axis + 1) % 3, c = (axis + 2) % 3;
  const float3 way = ((face & 1) - at[axis]) * edges[axis] + (fmin(left / area[face], 1.0f) - at[b]) * edges[b] +
                     (xi.y - at[c]) * edges[c];
  return shape_place_of(way, cross(edges[b], edges[c]), total);
}

#endif
