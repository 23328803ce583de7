// dda_gauss2: trilinear density along a ray is a cubic inside a cell, so two Gauss–Legendre points are exact.
#ifndef BRUME_WALK_DDA_GAUSS2_CL
#define BRUME_WALK_DDA_GAUSS2_CL
#include "walk/cells.cl"

// Also the share of ∫ρ that the second point stands for. Both lie in one cell, whose corners are loaded once.
static inline floatW dda_gauss2_shares(__global const Voxel* voxels, const MediumRay* ray, const Segments* at,
                                       floatW* second) {
  const floatW middle = lanes_load(at->place), size = lanes_load(at->size);
  const floatW away = size * 0.288675134594813f;  // 1 / (2 √3)
  const Lookup first = lookup_at(ray, at, middle - away, WITHIN_CELL),
               last = lookup_at(ray, at, middle + away, WITHIN_CELL);
  floatW corner[8];
  lookup_corners(voxels, first.sample, corner);
  const floatW before = density_of(at, corners_blend(corner, &first)),
               after = density_of(at, corners_blend(corner, &last)), sum = before + after;
  *second = lanes_select((floatW)(0.5f), after / sum, sum > 0.0f);
  return 0.5f * size * sum;
}

static inline floatW dda_gauss2_integral(const Medium* medium, __global const Voxel* voxels, const MediumRay* ray,
                                         const Segments* at) {
  (void)medium;
  floatW second;
  return dda_gauss2_shares(voxels, ray, at, &second);
}

// a(u) + (f + d u) (b(u) - a(u)): two polynomials of this degree blended along one axis, on which f + d u is the place.
static inline void lerp_cubic(floatW f, floatW d, const floatW* a, const floatW* b, int degree, floatW* out) {
  for (int k = 0; k <= degree; ++k) out[k] = mad_exact(f, b[k] - a[k], a[k]);
  out[degree + 1] = (floatW)(0.0f);
  for (int k = 0; k <= degree; ++k) out[k + 1] = mad_exact(d, b[k] - a[k], out[k + 1]);
}

// ∫ρ from where each segment begins to u of its length, exactly: u (c[0] + u (c[1] + u (c[2] + u c[3]))).
static inline void dda_gauss2_growth(__global const Voxel* voxels, const MediumRay* ray, const Segments* at,
                                     floatW* c) {
  const floatW size = lanes_load(at->size);
  const Lookup l = lookup_at(ray, at, lanes_load(at->begin), WITHIN_CELL);
  floatW corner[8], along_x[4][2], along_y[2][3];
  lookup_corners(voxels, l.sample, corner);
  for (int k = 0; k < 4; ++k) lerp_cubic(l.fx, size * ray->dir.x, &corner[2 * k], &corner[2 * k + 1], 0, along_x[k]);
  for (int k = 0; k < 2; ++k) lerp_cubic(l.fy, size * ray->dir.y, along_x[2 * k], along_x[2 * k + 1], 1, along_y[k]);
  lerp_cubic(l.fz, size * ray->dir.z, along_y[0], along_y[1], 2, c);
#if BRUME_STORAGE == 2
  for (int k = 0; k < 4; ++k) c[k] = mad_exact(c[k], lanes_load(at->part), k ? (floatW)(0.0f) : lanes_load(at->zero));
#endif
  for (int k = 0; k < 4; ++k) c[k] *= size * (1.0f / (float)(k + 1));
}

#endif
