// Where W rays cross the iso-surface of one trilinear cell each, by the operations of cell_crossing: the same bits.
#ifndef BRUME_SHAPES_CROSSINGS_TOGETHER_CL
#define BRUME_SHAPES_CROSSINGS_TOGETHER_CL
#include "shapes/cell_crossing.cl"
#include "shapes/rays.cl"

#if W > 1

// CellRay of each lane.
typedef struct {
  floatW corner[8];
  floatW iso;
  LaneVectors p, d;
} LanesCell;

typedef struct {
  floatW c0, c1, c2, c3, doubt;
} LanesCubic;

static inline floatW lanes_cubic_at(const LanesCubic* c, floatW u) {
  return mad_exact(mad_exact(mad_exact(c->c3, u, c->c2), u, c->c1), u, c->c0);
}

// cell_cubic
static inline LanesCubic lanes_cubic(const LanesCell* cell) {
  floatW v[8], largest = (floatW)(0.0f);
  for (int i = 0; i < 8; ++i) {
    v[i] = cell->corner[i] - cell->iso;
    largest = fmax_ordered(largest, fabs(v[i]));
  }
  const floatW px = cell->p.v[0], py = cell->p.v[1], pz = cell->p.v[2];
  const floatW dx = cell->d.v[0], dy = cell->d.v[1], dz = cell->d.v[2];
  const floatW x = v[1] - v[0], y = v[2] - v[0], z = v[4] - v[0];
  const floatW xy = (v[3] - v[2]) - x, xz = (v[5] - v[4]) - x, yz = (v[6] - v[4]) - y;
  const floatW xyz = ((v[7] - v[6]) - (v[5] - v[4])) - xy;
  const floatW mixed_x = mad_exact(xyz, pz, xy), mixed_y = mad_exact(xyz, py, xz), mixed_z = mad_exact(xyz, px, yz);
  const floatW along_z = mad_exact(xz, pz, x), across_z = mad_exact(yz, pz, y);
  const floatW slope_x = mad_exact(mixed_x, py, along_z), slope_y = mad_exact(mixed_x, px, across_z),
               slope_z = mad_exact(mixed_y, px, mad_exact(yz, py, z));
  LanesCubic c;
  c.c0 = mad_exact(slope_x, px, mad_exact(across_z, py, mad_exact(z, pz, v[0])));
  c.c1 = slope_x * dx + slope_y * dy + slope_z * dz;
  c.c2 = mad_exact(mixed_x * dx, dy, mad_exact(mixed_y * dx, dz, mixed_z * dy * dz));
  c.c3 = xyz * dx * dy * dz;
  c.doubt = largest * CROSSING_DOUBT;
  return c;
}

// cell_above_exact of some, as bits of lanes.
OUTLINED intW lanes_above_exact(const LanesCell* cells, floatW u, intW above, uint some) {
  float corner[8][W], p[3][W], d[3][W], iso[W], at[W];
  int its[W];
  for (int i = 0; i < 8; ++i) lanes_store(cells->corner[i], corner[i]);
  for (int k = 0; k < 3; ++k) {
    lanes_store(cells->p.v[k], p[k]);
    lanes_store(cells->d.v[k], d[k]);
  }
  lanes_store(cells->iso, iso);
  lanes_store(u, at);
  lanes_store_int(above, its);
  for (; some != 0; some &= some - 1) {
    const int lane = lowest_bit(some);
    CellRay cell;
    for (int i = 0; i < 8; ++i) cell.corner[i] = corner[i][lane];
    cell.iso = iso[lane];
    cell.p = lane_vector(p, lane);
    cell.d = lane_vector(d, lane);
    its[lane] = -cell_above_exact(&cell, at[lane]);
  }
  return lanes_load_int(its);
}

// cell_above of some
static inline intW lanes_above(const LanesCell* cells, const LanesCubic* c, floatW u, intW some) {
  const floatW f = lanes_cubic_at(c, u);
  const intW above = f > 0.0f, doubtful = some & !(fabs(f) > c->doubt);
  return lanes_any(doubtful) ? lanes_above_exact(cells, u, above, lanes_bits(doubtful)) : above;
}

// cubic_root of some
static inline floatW lanes_root(const LanesCubic* c, floatW a, floatW b, intW some) {
  const floatW at_a = lanes_cubic_at(c, a), at_b = lanes_cubic_at(c, b);
  const intW above = at_a > 0.0f, even = above == (at_b > 0.0f);
  floatW u = lanes_select(a + (b - a) * (at_a / (at_a - at_b)), lanes_select(b, a, fabs(at_a) < fabs(at_b)), even);
  intW open = some & ~even;
  for (int step = 0; step < CROSSING_STEPS && lanes_any(open); ++step) {
    const floatW f = lanes_cubic_at(c, u);
    const intW before = (f > 0.0f) == above;
    a = lanes_select(a, u, before);
    b = lanes_select(u, b, before);
    const floatW slope = mad_exact(mad_exact(3.0f * c->c3, u, 2.0f * c->c2), u, c->c1);
    floatW next = u - f / slope;
    next = lanes_select(0.5f * (a + b), next, (next >= a) & (next <= b));
    const intW enough = fabs(next - u) <= CROSSING_ENOUGH;
    u = lanes_select(u, next, open);
    open &= ~enough;
  }
  return u;
}

// cell_crossing of some: u of each; *inside of the others stays.
static inline floatW lanes_cross(const LanesCell* cells, intW some, intW* inside) {
  const LanesCubic c = lanes_cubic(cells);
  const floatW none = (floatW)(CROSSING_NONE), zero = (floatW)(0.0f);
  const intW above = lanes_above(cells, &c, zero, some), first = above & 1;
  const intW turned = some & (*inside >= 0) & (*inside != first);
  const floatW b1 = c.c0 + (1.0f / 3.0f) * c.c1, b2 = b1 + (1.0f / 3.0f) * (c.c1 + c.c2),
               b3 = (c.c0 + c.c1) + (c.c2 + c.c3);
  const floatW least = fmin_ordered(fmin_ordered(c.c0, b1), fmin_ordered(b2, b3)),
               most = fmax_ordered(fmax_ordered(c.c0, b1), fmax_ordered(b2, b3));
  intW open = some & ~turned & ~((least > c.doubt) | (most < -c.doubt));
  const floatW root = sqrt(fmax(mad_exact(c.c2, c.c2, -3.0f * c.c3 * c.c1), 0.0f)), q = -(c.c2 + copysign(root, c.c2));
  const floatW e0 = q / (3.0f * c.c3), e1 = c.c1 / q;
  const floatW ends[3] = {fmin_ordered(e0, e1), fmax_ordered(e0, e1), (floatW)(1.0f)};
  floatW from = zero, to = zero;
  intW crossed = (intW)(0);
  for (int i = 0; i < 3; ++i) {
    const intW within = open & (ends[i] > from) & (ends[i] <= 1.0f);
    const intW changes = within & (lanes_above(cells, &c, ends[i], within) != above);
    to = lanes_select(to, ends[i], changes);
    from = lanes_select(from, ends[i], within & ~changes);
    crossed |= changes;
    open &= ~changes;
  }
  floatW u = lanes_select(none, zero, turned);
  if (lanes_any(crossed)) u = lanes_select(u, lanes_root(&c, from, to, crossed), crossed);
  *inside = select(*inside, select(first, 1 - first, crossed), some);
  return u;
}

#endif
#endif
