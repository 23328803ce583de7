// Closed cylinder: side and two caps. Hits are found in the cylinder's own frame, z along the axis.
#ifndef BRUME_SHAPES_CYLINDER_CL
#define BRUME_SHAPES_CYLINDER_CL
#include "shapes/quadratic.cl"
#include "shapes/shape.cl"

typedef struct {
  float3 base, axis, side_x, side_y;
  float height, radius;
} Cylinder;

static inline Cylinder cylinder_load(const Shape* shape) {
  Cylinder c;
  c.base = shape_vec(shape, 0);
  c.axis = shape_vec(shape, 3);
  c.height = shape->data[6];
  c.radius = shape->data[7];
  c.side_x = shape_vec(shape, 8);
  c.side_y = cross(c.axis, c.side_x);
  return c;
}

static inline float3 cylinder_frame(const Cylinder* c, float3 v) {
  return (float3)(dot(v, c->side_x), dot(v, c->side_y), dot(v, c->axis));
}

static inline float cylinder_hit(const Shape* shape, float3 origin, float3 dir) {
  const Cylinder c = cylinder_load(shape);
  const float3 o = cylinder_frame(&c, origin - c.base);
  const float3 d = cylinder_frame(&c, dir);
  float best = INFINITY;
  const float a = mad_exact(d.x, d.x, d.y * d.y);
  if (a > 0.0f) {
    const float b = mad_exact(o.x, d.x, o.y * d.y);
    const float cross_z = mad_exact(o.x, d.y, -o.y * d.x);  // discriminant = a r² - (o × d)²: no cancellation far away
    const float k = mad_exact(o.x, o.x, mad_exact(o.y, o.y, -c.radius * c.radius));
    float t[2];
    if (quadratic_roots(a, b, k, mad_exact(a * c.radius, c.radius, -cross_z * cross_z), &t[0], &t[1])) {
      for (int i = 0; i < 2; ++i) {
        const float z = mad_exact(t[i], d.z, o.z);
        if (t[i] > 0.0f && t[i] < best && z >= 0.0f && z <= c.height) best = t[i];
      }
    }
  }
  if (d.z != 0.0f) {
    for (int i = 0; i < 2; ++i) {
      const float t = ((i ? c.height : 0.0f) - o.z) / d.z;
      const float x = mad_exact(t, d.x, o.x), y = mad_exact(t, d.y, o.y);
      if (t > 0.0f && t < best && x * x + y * y <= c.radius * c.radius) best = t;
    }
  }
  return best;
}

// Outward normal: the surface (side or a cap) to which the point is nearest.
static inline float3 cylinder_normal(const Shape* shape, float3 point, int textured, float2* uv) {
  const Cylinder c = cylinder_load(shape);
  const float3 p = cylinder_frame(&c, point - c.base);
  const float radial = sqrt(p.x * p.x + p.y * p.y);
  const float from_side = fabs(c.radius - radial);
  const float from_cap = fmin(fabs(p.z), fabs(c.height - p.z));
  if (from_cap < from_side) {
    if (textured) *uv = (float2)(0.5f * (p.x / c.radius + 1.0f), 0.5f * (p.y / c.radius + 1.0f));
    return p.z < 0.5f * c.height ? -c.axis : c.axis;
  }
  if (textured) *uv = (float2)(azimuth(p.y, p.x), p.z / c.height);
  return (p.x * c.side_x + p.y * c.side_y) / radial;
}

// Of the side the arc that is seen, and of the caps those whose outside is; from inside all.
static inline ShapePlace cylinder_emit(const Shape* shape, float3 from, float2 xi) {
  const Cylinder c = cylinder_load(shape);
  const float3 p = cylinder_frame(&c, from - c.base);
  const float radial = sqrt(p.x * p.x + p.y * p.y);
  const int within = radial <= c.radius, inside = within && p.z >= 0.0f && p.z <= c.height;
  const float arc = inside ? PI_F : (within ? 0.0f : acos(c.radius / radial));
  const float side = 2.0f * arc * c.radius * c.height, cap = PI_F * c.radius * c.radius;
  const float bottom = inside || p.z < 0.0f ? cap : 0.0f, top = inside || p.z > c.height ? cap : 0.0f;
  const float area = side + bottom + top, at = xi.x * area;
  float3 q, n;
  if (at < side) {
    const float angle = (2.0f * at / side - 1.0f) * arc, e_x = radial > 0.0f ? p.x / radial : 1.0f;
    const float e_y = radial > 0.0f ? p.y / radial : 0.0f;
    n = (float3)(e_x * cos(angle) - e_y * sin(angle), e_y * cos(angle) + e_x * sin(angle), 0.0f);
    q = (float3)(c.radius * n.x, c.radius * n.y, xi.y * c.height);
  } else {
    const int at_top = at - side >= bottom;
    const float out = c.radius * sqrt(fmin((at - side - (at_top ? bottom : 0.0f)) / cap, 1.0f));
    n = (float3)(0.0f, 0.0f, 1.0f);
    q = (float3)(out * cos(2.0f * PI_F * xi.y), out * sin(2.0f * PI_F * xi.y), at_top ? c.height : 0.0f);
  }
  const float3 way = q - p;
  return shape_place_of(way.x * c.side_x + way.y * c.side_y + way.z * c.axis,
                        n.x * c.side_x + n.y * c.side_y + n.z * c.axis, area);
}

#endif
