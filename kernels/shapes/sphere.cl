// Sphere: nearest positive root of |o + t d - c|² = r².
#ifndef BRUME_SHAPES_SPHERE_CL
#define BRUME_SHAPES_SPHERE_CL
#include "shapes/quadratic.cl"
#include "shapes/shape.cl"

// The discriminant comes from the distance of the centre to the ray, not from b² - ac: that difference loses everything
// for a far, small sphere [Haines19].
static inline float sphere_hit(const Shape* shape, float3 origin, float3 dir) {
  const float radius = shape->data[3];
  const float3 f = origin - shape_vec(shape, 0);
  const float b = dot(f, dir);
  const float3 perpendicular = f - b * dir;
  const float discriminant = mad_exact(radius, radius, -dot(perpendicular, perpendicular));
  float t0, t1;
  if (!quadratic_roots(1.0f, b, mad_exact(-radius, radius, dot(f, f)), discriminant, &t0, &t1)) return INFINITY;
  return t0 > 0.0f ? t0 : (t1 > 0.0f ? t1 : INFINITY);
}

static inline float2 sphere_uv(float3 normal) {
#if BRUME_TEXTURED
  return (float2)(azimuth(-normal.z, normal.x), 1.0f - acos(clamp(normal.y, -1.0f, 1.0f)) * INV_PI_F);
#else
  return (float2)(0.0f);
#endif
}

static inline float3 sphere_normal(const Shape* shape, float3 point, int textured, float2* uv) {
  const float3 n = normalize(point - shape_vec(shape, 0));
  if (textured) *uv = sphere_uv(n);
  return n;
}

// Evenly over the cone that it fills [Shirley96]; from inside, over the sphere.
static inline ShapePlace sphere_emit(const Shape* shape, float3 from, float2 xi) {
  const float radius = shape->data[3], turn = 2.0f * PI_F * xi.y;
  const float3 to = shape_vec(shape, 0) - from;
  const float square = dot(to, to), share = radius * radius / square;  // sin² of the cone's half angle
  if (!(share < 1.0f)) {
    const float z = 1.0f - 2.0f * xi.x, side = sqrt(fmax(1.0f - z * z, 0.0f));
    const float3 n = (float3)(side * cos(turn), side * sin(turn), z);
    return shape_place_of(to + radius * n, n, 4.0f * PI_F * radius * radius);
  }
  const float wide = share / (1.0f + sqrt(1.0f - share));  // 1 - cos
  const float beside = xi.x * wide, sine2 = beside * (2.0f - beside), distance = sqrt(square);
  const Frame3 frame = frame_about(to / distance);
  const float t = distance * (1.0f - beside) - sqrt(fmax(radius * radius - square * sine2, 0.0f));
  ShapePlace place;
  place.way = t * ((1.0f - beside) * frame.z + sqrt(sine2) * (cos(turn) * frame.x + sin(turn) * frame.y));
  place.solid = 2.0f * PI_F * wide;
  return place;
}

#endif
