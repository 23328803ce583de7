// Where a ray crosses the iso-surface of one trilinear cell: along the ray the density is a cubic. Its extremes cut the
// way into monotone parts, so that no two crossings hide between two ends of the same side.
#ifndef BRUME_SHAPES_CELL_CROSSING_CL
#define BRUME_SHAPES_CELL_CROSSING_CL
#include "lib/vec.cl"

#define CROSSING_NONE (-1.0f)
#define CROSSING_STEPS 24        // of the root finder; it converges in 3 to 6
#define CROSSING_ENOUGH 3e-8f    // of the way through the cell
#define CROSSING_DOUBT 0x1p-18f  // of the largest corner: what rounding may leave of a value

// A ray through the unit cell: p + u d is in it for u in [0, 1].
typedef struct {
  float corner[8];  // density, x fastest
  float iso;
  float3 p, d;
} CellRay;

// Density less iso along the ray: ((c3 u + c2) u + c1) u + c0.
typedef struct {
  float c0, c1, c2, c3;
  float doubt;  // no smaller value has a sign that is certain
} Cubic;

static inline float cubic_at(const Cubic* c, float u) {
  return mad_exact(mad_exact(mad_exact(c->c3, u, c->c2), u, c->c1), u, c->c0);
}

static inline Cubic cell_cubic(const CellRay* cell) {
  float v[8], largest = 0.0f;
  for (int i = 0; i < 8; ++i) {
    v[i] = cell->corner[i] - cell->iso;
    largest = fmax_ordered(largest, fabs(v[i]));
  }
  const float3 p = cell->p, d = cell->d;
  // v0 + x.. X + y.. Y + z.. Z + xy XY + xz XZ + yz YZ + xyz XYZ
  const float x = v[1] - v[0], y = v[2] - v[0], z = v[4] - v[0];
  const float xy = (v[3] - v[2]) - x, xz = (v[5] - v[4]) - x, yz = (v[6] - v[4]) - y;
  const float xyz = ((v[7] - v[6]) - (v[5] - v[4])) - xy;
  // the same about p
  const float3 mixed = (float3)(mad_exact(xyz, p.z, xy), mad_exact(xyz, p.y, xz), mad_exact(xyz, p.x, yz));
  const float3 slope =
      (float3)(mad_exact(mixed.x, p.y, mad_exact(xz, p.z, x)), mad_exact(mixed.x, p.x, mad_exact(yz, p.z, y)),
               mad_exact(mixed.y, p.x, mad_exact(yz, p.y, z)));
  Cubic c;
  c.c0 = mad_exact(mad_exact(mixed.x, p.y, mad_exact(xz, p.z, x)), p.x,
                   mad_exact(mad_exact(yz, p.z, y), p.y, mad_exact(z, p.z, v[0])));
  c.c1 = dot(slope, d);
  c.c2 = mad_exact(mixed.x * d.x, d.y, mad_exact(mixed.y * d.x, d.z, mixed.z * d.y * d.z));
  c.c3 = xyz * d.x * d.y * d.z;
  c.doubt = largest * CROSSING_DOUBT;
  return c;
}

// A number as the sum of two floats, the second below the rounding of the first [Dekker71].
typedef struct {
  float high, low;
} Twofold;

static inline Twofold twofold_sum(float a, float b) {
  Twofold r;
  r.high = a + b;
  const float of_b = r.high - a;
  r.low = (a - (r.high - of_b)) + (b - of_b);
  return r;
}

static inline Twofold twofold_product(float a, float b) {
  Twofold r;
  r.high = a * b;
  r.low = fma(a, b, -r.high);
  return r;
}

static inline Twofold twofold_add(Twofold a, Twofold b) {
  const Twofold s = twofold_sum(a.high, b.high);
  return twofold_sum(s.high, s.low + (a.low + b.low));
}

static inline Twofold twofold_multiply(Twofold a, Twofold b) {
  const Twofold p = twofold_product(a.high, b.high);
  return twofold_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
}

static inline Twofold twofold_blend(Twofold a, Twofold b, Twofold share) {
  const Twofold minus_a = {-a.high, -a.low};
  return twofold_add(a, twofold_multiply(share, twofold_add(b, minus_a)));
}

static inline Twofold twofold_place(float p, float d, float u) {
  const Twofold from = {p, 0.0f};
  return twofold_add(from, twofold_product(u, d));
}

// Whether the density at u is above iso, in twice the digits: blends of the corners, in which nothing cancels that
// matters.
OUTLINED int cell_above_exact(const CellRay* cell, float u) {
  Twofold v[8];
  for (int i = 0; i < 8; ++i) v[i] = twofold_sum(cell->corner[i], -cell->iso);
  const Twofold x = twofold_place(cell->p.x, cell->d.x, u), y = twofold_place(cell->p.y, cell->d.y, u),
                z = twofold_place(cell->p.z, cell->d.z, u);
  for (int i = 0; i < 4; ++i) v[i] = twofold_blend(v[2 * i], v[2 * i + 1], x);
  for (int i = 0; i < 2; ++i) v[i] = twofold_blend(v[2 * i], v[2 * i + 1], y);
  const Twofold f = twofold_blend(v[0], v[1], z);
  return f.high > 0.0f;
}

static inline int cell_above(const CellRay* cell, const Cubic* c, float u) {
  const float f = cubic_at(c, u);
  return fabs(f) > c->doubt ? f > 0.0f : cell_above_exact(cell, u);
}

// The root between a and b, where the cubic is monotone and changes its side: Newton's steps, and halves where they
// leave the bracket.
static inline float cubic_root(const Cubic* c, float a, float b) {
  const float at_a = cubic_at(c, a), at_b = cubic_at(c, b);
  if ((at_a > 0.0f) == (at_b > 0.0f)) return fabs(at_a) < fabs(at_b) ? a : b;  // rounding: it is at one of them
  float u = a + (b - a) * (at_a / (at_a - at_b));
  for (int step = 0; step < CROSSING_STEPS; ++step) {
    const float f = cubic_at(c, u);
    if ((f > 0.0f) == (at_a > 0.0f))
      a = u;
    else
      b = u;
    const float slope = mad_exact(mad_exact(3.0f * c->c3, u, 2.0f * c->c2), u, c->c1);
    float next = u - f / slope;
    if (!(next >= a && next <= b)) next = 0.5f * (a + b);
    if (fabs(next - u) <= CROSSING_ENOUGH) return next;
    u = next;
  }
  return u;
}

// The first u at which the ray comes to the other side of the surface, or CROSSING_NONE. *inside: on which side it
// comes in, -1 where that is not known, and then on which side it is behind u. What one cell takes for a side the next
// one goes on with: a crossing on their common face that one rounds away the other finds, there.
static inline float cell_crossing(const CellRay* cell, int* inside) {
  const Cubic c = cell_cubic(cell);
  const int first = cell_above(cell, &c, 0.0f), known = *inside >= 0 ? *inside : first;
  *inside = first;
  if (first != known) return 0.0f;
  // All of a cubic lies between its Bernstein coefficients: mostly they are of one side.
  const float b1 = c.c0 + (1.0f / 3.0f) * c.c1, b2 = b1 + (1.0f / 3.0f) * (c.c1 + c.c2),
              b3 = (c.c0 + c.c1) + (c.c2 + c.c3);
  const float least = fmin_ordered(fmin_ordered(c.c0, b1), fmin_ordered(b2, b3)),
              most = fmax_ordered(fmax_ordered(c.c0, b1), fmax_ordered(b2, b3));
  if (least > c.doubt || most < -c.doubt) return CROSSING_NONE;
  // The extremes; one that is no number is in no part of the way.
  const float root = sqrt(fmax(mad_exact(c.c2, c.c2, -3.0f * c.c3 * c.c1), 0.0f)), q = -(c.c2 + copysign(root, c.c2));
  const float e0 = q / (3.0f * c.c3), e1 = c.c1 / q;
  const float ends[3] = {fmin_ordered(e0, e1), fmax_ordered(e0, e1), 1.0f};
  float from = 0.0f;
  for (int i = 0; i < 3; ++i) {
    const float to = ends[i];
    if (!(to > from && to <= 1.0f)) continue;
    if (cell_above(cell, &c, to) != first) {
      *inside = !first;
      return cubic_root(&c, from, to);
    }
    from = to;
  }
  return CROSSING_NONE;
}

#endif
