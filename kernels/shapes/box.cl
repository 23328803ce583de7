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
static inline float3 box_normal(const Shape* shape, float3 point, float2* uv) {
  const Affine a = shape_affine(shape);
  const float3 p = affine_point(&a, point);
  const float3 d =
      (float3)(fmin(fabs(p.x), fabs(1.0f - p.x)), fmin(fabs(p.y), fabs(1.0f - p.y)), fmin(fabs(p.z), fabs(1.0f - p.z)));
  if (d.x <= d.y && d.x <= d.z) {
    *uv = p.yz;
    return vec_unit((float3)(a.m[0], a.m[1], a.m[2])) * (p.x < 0.5f ? -1.0f : 1.0f);
  }
  if (d.y <= d.z) {
    *uv = p.xz;
    return vec_unit((float3)(a.m[4], a.m[5], a.m[6])) * (p.y < 0.5f ? -1.0f : 1.0f);
  }
  *uv = p.xy;
  return vec_unit((float3)(a.m[8], a.m[9], a.m[10])) * (p.z < 0.5f ? -1.0f : 1.0f);
}

#endif
