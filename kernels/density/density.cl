// Density at W points, each anywhere: of different rays, of a gradient, of an iso-surface. Each finds its own brick; a
// walk along one ray knows the bricks from its steps and looks up by density/medium.cl.
#ifndef BRUME_DENSITY_DENSITY_CL
#define BRUME_DENSITY_DENSITY_CL
#include "density/bricks.cl"

// 1 (of a vector: -1) in the lanes where lo <= position <= hi.
#define density_inside(position, lo, hi) (((position) >= (floatW)(lo)) & ((position) <= (floatW)(hi)))

// The cell of a position, moved into the grid.
static inline floatW density_cell(floatW position, int cells) {
  return fmin(fmax(floor(position), (floatW)(0.0f)), (floatW)((float)(cells - 1)));
}

// Density of a medium at W points of its cell space; 0 outside of its box [lo, hi], also where a coordinate is no
// number.
static inline floatW density_at(const Scene* scene, const Medium* medium, floatW x, floatW y, floatW z) {
  const intW inside = density_inside(x, medium->lo.x, medium->hi.x) & density_inside(y, medium->lo.y, medium->hi.y) &
                      density_inside(z, medium->lo.z, medium->hi.z);
  if (medium->is_constant) return lanes_select((floatW)(0.0f), (floatW)(medium->constant_density), inside);
  const floatW cx = density_cell(x, medium->cells_x), cy = density_cell(y, medium->cells_y),
               cz = density_cell(z, medium->cells_z);
  const intW ix = lanes_to_int(cx), iy = lanes_to_int(cy), iz = lanes_to_int(cz);
  const intW bx = ix / BRICK_CELLS, by = iy / BRICK_CELLS, bz = iz / BRICK_CELLS;
  const intW entry = brick_entries(scene, medium, bx, by, bz);
  const intW used = inside & (entry != (intW)(BRICK_EMPTY));
  if (!lanes_any(used)) return (floatW)(0.0f);
  // A lane that is not used looks into brick 0, for nothing.
  const intW number = lanes_select((intW)(0), entry, used);
  Lookup l;
  l.sample = brick_base(number, bx, by, bz) + brick_stride(ix, iy, iz);
  l.fx = x - cx;
  l.fy = y - cy;
  l.fz = z - cz;
  floatW density, next;
  if (medium->interpolation == INTERPOLATION_NEAREST)
    voxels_gather2(scene->voxels, l.sample, &density, &next);
  else
    density = lookup_blend(scene->voxels, &l);
#if BRUME_STORAGE == 2
  float zero[W], part[W];
  brick_scales(scene, number, zero, part);
  density = mad_exact(density, lanes_load(part), lanes_load(zero));
#endif
  return lanes_select((floatW)(0.0f), density, used);
}

#endif
