// Density at W points, each anywhere: of different rays, of a gradient, of an iso-surface. Each finds its own brick; a
// walk along one ray knows the bricks from its steps and looks up by density/medium.cl.
#ifndef BRUME_DENSITY_DENSITY_CL
#define BRUME_DENSITY_DENSITY_CL
#include "density/bricks.cl"

// 1 (of a vector: -1) in the lanes where lo <= position <= hi.
#define density_inside(position, lo, hi) (((position) >= (floatW)(lo)) & ((position) <= (floatW)(hi)))

// Density of a medium at W points of its cell space; 0 outside of its box [lo, hi], also where a coordinate is no
// number.
static inline floatW density_at(const Scene* scene, const Medium* medium, floatW x, floatW y, floatW z) {
  const intW inside = density_inside(x, medium->lo.x, medium->hi.x) & density_inside(y, medium->lo.y, medium->hi.y) &
                      density_inside(z, medium->lo.z, medium->hi.z);
  if (medium->is_constant) return lanes_select((floatW)(0.0f), (floatW)(medium->constant_density), inside);
  const intW ix = lanes_whole(x, (floatW)((float)(medium->cells_x - 1)));
  const intW iy = lanes_whole(y, (floatW)((float)(medium->cells_y - 1)));
  const intW iz = lanes_whole(z, (floatW)((float)(medium->cells_z - 1)));
  const intW bx = ix / BRICK_CELLS, by = iy / BRICK_CELLS, bz = iz / BRICK_CELLS;
  const intW entry = brick_entries(scene, medium, bx, by, bz);
  const intW used = inside & (entry != (intW)(BRICK_EMPTY));
  if (!lanes_any(used)) return (floatW)(0.0f);
  // A lane that is not used looks into brick 0, for nothing.
  const intW number = lanes_select((intW)(0), entry, used);
  Lookup l;
  l.sample = brick_base(number, bx, by, bz) + brick_stride(ix, iy, iz);
  l.fx = x - lanes_to_float(ix);
  l.fy = y - lanes_to_float(iy);
  l.fz = z - lanes_to_float(iz);
  return lanes_select((floatW)(0.0f), brick_density(scene, number, lookup_value(medium, scene->voxels, &l)), used);
}

#endif
