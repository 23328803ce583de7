// Optical depths to a light from the light grid of a medium (shared/medium.h), for all lanes at once.
#ifndef BRUME_RADIANCE_LIGHT_GRID_CL
#define BRUME_RADIANCE_LIGHT_GRID_CL
#include "radiance/tau.cl"

static inline int light_grid_points(const Medium* m) { return m->light_nx * m->light_ny * m->light_nz; }

// Coordinate among n points over [lo, hi]: the point before it and the weight of the next.
static inline intW light_grid_axis(floatW p, float lo, float hi, int n, floatW* weight) {
  const float last = (float)(n - 1);
  const floatW g = fmin(fmax((p - lo) * (last / (hi - lo)), (floatW)(0.0f)), (floatW)(last));
  const floatW before = fmin(floor(g), (floatW)(last - 1.0f));
  *weight = g - before;
  return lanes_to_int(before);
}

// Where the lanes stand in the grid.
typedef struct {
  intW point;
  floatW fx, fy, fz;
} LightGridPlace;

static inline LightGridPlace light_grid_place(const Medium* m, const MediumRay* ray, floatW s) {
  LightGridPlace p;
  const floatW px = mad_exact(s, (floatW)(ray->dir.x), (floatW)(ray->origin.x));
  const floatW py = mad_exact(s, (floatW)(ray->dir.y), (floatW)(ray->origin.y));
  const floatW pz = mad_exact(s, (floatW)(ray->dir.z), (floatW)(ray->origin.z));
  const intW x = light_grid_axis(px, m->lo.x, m->hi.x, m->light_nx, &p.fx);
  const intW y = light_grid_axis(py, m->lo.y, m->hi.y, m->light_ny, &p.fy);
  const intW z = light_grid_axis(pz, m->lo.z, m->hi.z, m->light_nz, &p.fz);
  p.point = (z * m->light_ny + y) * m->light_nx + x;
  return p;
}

static inline floatW light_grid_tau(const Medium* m, __global const float* light_tau, const LightGridPlace* at,
                                    int lights, int light, int channel) {
  const int first = m->light_offset * TAU_CHANNELS + (channel * lights + light) * light_grid_points(m);
  const int row = m->light_nx, slice = m->light_nx * m->light_ny;
  floatW a, b;
#define ALONG_X(out, offset)                                              \
  lanes_gather2(light_tau, at->point + (intW)(first + (offset)), &a, &b); \
  const floatW out = mad_exact(at->fx, b - a, a)
  ALONG_X(v00, 0);
  ALONG_X(v10, row);
  ALONG_X(v01, slice);
  ALONG_X(v11, slice + row);
#undef ALONG_X
  const floatW v0 = mad_exact(at->fy, v10 - v00, v00);
  const floatW v1 = mad_exact(at->fy, v11 - v01, v01);
  return mad_exact(at->fz, v1 - v0, v0);
}

#endif
