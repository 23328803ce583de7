// What a ray finds at its hit: point, normals facing the viewer, texture coordinates, material.
#ifndef BRUME_MATERIALS_SURFACE_CL
#define BRUME_MATERIALS_SURFACE_CL
#include "shapes/shapes.cl"

typedef struct {
  float3 point, geometric_normal, normal;
  float2 uv;
  int leaving;  // the ray comes from the side to which the shape's own normal does not point: from inside a closed one
  float epsilon;  // offset of rays that leave the point, PICTURE, Hits
  int material;
} Surface;

static inline float3 triangle_normal(const Triangle* t, const Hit* hit, float3 geometric) {
  if (t->shading == TRIANGLE_FLAT) return geometric;
  return normalize((1.0f - hit->u - hit->v) * vec_unpack(t->n[0]) + hit->u * vec_unpack(t->n[1]) +
                   hit->v * vec_unpack(t->n[2]));
}

static inline float2 triangle_uv(const Triangle* t, float w, float u, float v) {
  return (float2)(w * t->uv[0] + u * t->uv[2] + v * t->uv[4], w * t->uv[1] + u * t->uv[3] + v * t->uv[5]);
}

// Of a point where a ray ends with that hit.
static inline float surface_epsilon(const Scene* scene, float3 point, const Hit* hit) {
  const float size = fmax(vec_max_abs(point), hit->t);
#if BRUME_INSTANCES
  if (hit->instance != INSTANCE_NONE) return 0x1p-17f * fmax(size, scene->instances[hit->instance].reach);
#endif
  return 0x1p-17f * size;
}

static inline int is_textured(const Scene* scene, int material) {
  return BRUME_TEXTURED &&
         (scene->materials[material].texture >= 0 || scene->materials[material].emission_texture >= 0);
}

// *s: of the hit. uv of shapes are 0 where no texture asks: azimuths take longer than the rest of a sphere.
static inline void surface_at(const Scene* scene, float3 origin, float3 dir, const Hit* hit, Surface* s) {
  s->uv = (float2)(0.0f);
  s->point = vec_point(origin, dir, hit->t);
  int known = -1;  // whether the ray comes from inside, where the hit says so
#if BRUME_TRIANGLES
  if (hit->primitive >= FIRST_TRIANGLE) {
    const Triangle t = triangle_of(scene, hit->primitive, hit->instance, &s->geometric_normal);
    s->normal = triangle_normal(&t, hit, s->geometric_normal);
    s->uv = triangle_uv(&t, 1.0f - hit->u - hit->v, hit->u, hit->v);
    s->material = t.material;
  } else
#endif
  {
    const Shape shape = scene->shapes[hit->primitive];
    s->material = shape.material;
    if (USES_SHAPE(ISOSURFACE) && shape.type == SHAPE_ISOSURFACE) {
      s->normal = isosurface_normals(scene, &shape, s->point, dir, hit, &s->geometric_normal);
      known = hit->v > 0.0f;
    } else {
      s->normal = s->geometric_normal = shape_normal(&shape, s->point, is_textured(scene, s->material), &s->uv);
    }
  }
  s->leaving = known >= 0 ? known : dot(s->geometric_normal, dir) > 0.0f;
  if (s->leaving) {
    s->geometric_normal = -s->geometric_normal;
    s->normal = -s->normal;
  }
  s->epsilon = surface_epsilon(scene, s->point, hit);
}

#if BRUME_GOURAUD && BRUME_TRIANGLES
// Corner k of the triangle that was hit, as a surface of its own with the texture of the hit; *share: what it counts.
static inline Surface surface_corner(const Scene* scene, const Triangle* t, const Hit* hit, const Surface* surface,
                                     int k, float* share) {
  Surface s = *surface;
  s.point = vec_unpack(t->p[k]);
  s.normal = vec_unpack(t->n[k]) * (s.leaving ? -1.0f : 1.0f);
  s.epsilon = surface_epsilon(scene, s.point, hit);
  *share = k == 0 ? 1.0f - hit->u - hit->v : (k == 1 ? hit->u : hit->v);
  return s;
}
#endif

// Start of a ray that leaves the surface in direction dir.
static inline float3 surface_leave(const Surface* s, float3 dir) {
  return s->point + s->geometric_normal * (dot(s->geometric_normal, dir) < 0.0f ? -s->epsilon : s->epsilon);
}

// How far in direction dir that start is from the surface.
static inline float surface_gap(const Surface* s, float3 dir) {
  return s->epsilon * fabs(dot(s->geometric_normal, dir));
}

#endif
