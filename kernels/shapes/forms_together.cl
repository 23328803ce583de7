// The closed forms against W rays at once, by the operations of sphere_hit and its like: the same bits as alone.
#ifndef BRUME_SHAPES_FORMS_TOGETHER_CL
#define BRUME_SHAPES_FORMS_TOGETHER_CL
#include "shapes/rays.cl"
#include "shapes/shapes.cl"

#if W > 1

#define LANES_MISS ((floatW)(INFINITY))

static inline floatW lanes_dot(const LaneVectors* a, const LaneVectors* b) {
  return a->v[0] * b->v[0] + a->v[1] * b->v[1] + a->v[2] * b->v[2];
}

static inline floatW lanes_dot_with(const LaneVectors* a, float3 b) {
  return a->v[0] * b.x + a->v[1] * b.y + a->v[2] * b.z;
}

static inline LaneVectors lanes_less(const LaneVectors* a, float3 b) {
  LaneVectors r;
  r.v[0] = a->v[0] - b.x;
  r.v[1] = a->v[1] - b.y;
  r.v[2] = a->v[2] - b.z;
  return r;
}

// The smaller of two that is positive.
static inline floatW lanes_first_positive(floatW t0, floatW t1) {
  return lanes_select(lanes_select(LANES_MISS, t1, t1 > 0.0f), t0, t0 > 0.0f);
}

// quadratic_roots: whether there are any.
static inline intW lanes_roots(floatW a, floatW b, floatW c, floatW discriminant, floatW* t0, floatW* t1) {
  const floatW root = sqrt(discriminant), q = -(b + copysign(root, b));
  const floatW r0 = q / a, r1 = lanes_select(c / q, (floatW)(0.0f), q == 0.0f);
  *t0 = fmin_ordered(r0, r1);
  *t1 = fmax_ordered(r0, r1);
  return discriminant >= 0.0f;
}

static inline floatW sphere_hit_lanes(const Shape* shape, const RayPacket* rays) {
  const floatW radius = (floatW)(shape->data[3]);
  const LaneVectors f = lanes_less(&rays->origin, shape_vec(shape, 0));
  const floatW b = lanes_dot(&f, &rays->dir);
  LaneVectors across;
  for (int k = 0; k < 3; ++k) across.v[k] = f.v[k] - b * rays->dir.v[k];
  const floatW discriminant = mad_exact(radius, radius, -lanes_dot(&across, &across));
  floatW t0, t1;
  const intW some =
      lanes_roots((floatW)(1.0f), b, mad_exact(-radius, radius, lanes_dot(&f, &f)), discriminant, &t0, &t1);
  return lanes_select(LANES_MISS, lanes_first_positive(t0, t1), some);
}

static inline floatW plane_hit_lanes(const Shape* shape, const RayPacket* rays) {
  const float3 normal = shape_vec(shape, 3), point = shape_vec(shape, 0);
  const floatW facing = lanes_dot_with(&rays->dir, normal);
  const LaneVectors* o = &rays->origin;
  const floatW t =
      (normal.x * (point.x - o->v[0]) + normal.y * (point.y - o->v[1]) + normal.z * (point.z - o->v[2])) / facing;
  return lanes_select(LANES_MISS, t, (facing != 0.0f) & (t > 0.0f));
}

static inline floatW quad_hit_lanes(const Shape* shape, const RayPacket* rays) {
  const floatW t = plane_hit_lanes(shape, rays);
  LaneVectors point;
  for (int k = 0; k < 3; ++k) point.v[k] = mad_exact(t, rays->dir.v[k], rays->origin.v[k]);
  const LaneVectors from_corner = lanes_less(&point, shape_vec(shape, 0));
  const floatW u = lanes_dot_with(&from_corner, shape_vec(shape, 6)),
               v = lanes_dot_with(&from_corner, shape_vec(shape, 9));
  return lanes_select(LANES_MISS, t, (t < INFINITY) & (u >= 0.0f) & (u <= 1.0f) & (v >= 0.0f) & (v <= 1.0f));
}

static inline floatW box_hit_lanes(const Shape* shape, const RayPacket* rays) {
  const Affine unit_from_world = shape_affine(shape);
  const LaneVectors o = lanes_mapped(&unit_from_world, &rays->origin, 1),
                    d = lanes_mapped(&unit_from_world, &rays->dir, 0);
  floatW t0 = (floatW)(-INFINITY), t1 = (floatW)(INFINITY);
  const intW inside = lanes_box_cut((float3)(0.0f), (float3)(1.0f), &o, &d, &t0, &t1);
  return lanes_select(LANES_MISS, lanes_first_positive(t0, t1), inside);
}

static inline LaneVectors lanes_in_cylinder(const Cylinder* c, const LaneVectors* v) {
  LaneVectors r;
  r.v[0] = lanes_dot_with(v, c->side_x);
  r.v[1] = lanes_dot_with(v, c->side_y);
  r.v[2] = lanes_dot_with(v, c->axis);
  return r;
}

static inline floatW cylinder_hit_lanes(const Shape* shape, const RayPacket* rays) {
  const Cylinder c = cylinder_load(shape);
  const LaneVectors from = lanes_less(&rays->origin, c.base);
  const LaneVectors o = lanes_in_cylinder(&c, &from), d = lanes_in_cylinder(&c, &rays->dir);
  const floatW radius = (floatW)(c.radius);
  const floatW a = mad_exact(d.v[0], d.v[0], d.v[1] * d.v[1]), b = mad_exact(o.v[0], d.v[0], o.v[1] * d.v[1]);
  const floatW cross_z = mad_exact(o.v[0], d.v[1], -o.v[1] * d.v[0]);
  const floatW k = mad_exact(o.v[0], o.v[0], mad_exact(o.v[1], o.v[1], -radius * radius));
  floatW t[2], best = LANES_MISS;
  const intW some = lanes_roots(a, b, k, mad_exact(a * radius, radius, -cross_z * cross_z), &t[0], &t[1]) & (a > 0.0f);
  for (int i = 0; i < 2; ++i) {
    const floatW z = mad_exact(t[i], d.v[2], o.v[2]);
    best = lanes_select(best, t[i], some & (t[i] > 0.0f) & (t[i] < best) & (z >= 0.0f) & (z <= c.height));
  }
  for (int i = 0; i < 2; ++i) {
    const floatW cap = ((i ? c.height : 0.0f) - o.v[2]) / d.v[2];
    const floatW x = mad_exact(cap, d.v[0], o.v[0]), y = mad_exact(cap, d.v[1], o.v[1]);
    best = lanes_select(best, cap,
                        (d.v[2] != 0.0f) & (cap > 0.0f) & (cap < best) & (x * x + y * y <= c.radius * c.radius));
  }
  return best;
}

// shape_hit of W rays. A row without its function does not compile.
static inline floatW shape_hit_lanes(const Shape* shape, const RayPacket* rays) {
#define ROW(id, name, help) \
  if (USES_SHAPE(id) && shape->type == SHAPE_##id) return name##_hit_lanes(shape, rays);
  BRUME_CLOSED_FORMS(ROW)
#undef ROW
  return LANES_MISS;
}

#endif
#endif
