// Optical depths to a light from a light grid (shared/light_grid.h), for all lanes at once.
#ifndef BRUME_MEDIA_LIGHT_GRID_CL
#define BRUME_MEDIA_LIGHT_GRID_CL
#include "media/tau.cl"

// Where the lanes stand in one plane of a grid: the first of the four points about each and the weights of the next
// ones.
typedef struct {
  intW point;
  floatW fu, fv;
} PlanePlace;

// Among n points of which the first is `first`: the point before x, and into *weight that of the next.
static inline floatW light_grid_axis(floatW x, floatW first, int n, floatW* weight) {
  const floatW g = x - first;
  const floatW before = lanes_to_float(lanes_whole(g, (floatW)((float)(n - 2))));
  *weight = g - before;
  return before;
}

static inline PlanePlace plane_place(const LightGrid* grid, floatW u, floatW v, floatW k) {
  PlanePlace p;
  const floatW before_u = light_grid_axis(u, floor(grid->slope_u * k), grid->nu, &p.fu);
  const floatW before_v = light_grid_axis(v, floor(grid->slope_v * k), grid->nv, &p.fv);
  p.point = (lanes_to_int(k) * grid->nv + lanes_to_int(before_v)) * grid->nu + lanes_to_int(before_u);
  return p;
}

typedef struct {
  PlanePlace before, next;
  floatW fk;
} LightGridPlace;

static inline LightGridPlace light_grid_place(const LightGrid* grid, const MediumRay* ray, floatW s) {
  const float3 origin = affine_point(&grid->grid_from_cell, ray->origin);
  const float3 dir = affine_dir(&grid->grid_from_cell, ray->dir);
  const floatW u = mad_exact(s, (floatW)(dir.x), (floatW)(origin.x));
  const floatW v = mad_exact(s, (floatW)(dir.y), (floatW)(origin.y));
  const floatW k = mad_exact(s, (floatW)(dir.z), (floatW)(origin.z));
  LightGridPlace p;
  const floatW plane = light_grid_axis(k, (floatW)(0.0f), grid->nk, &p.fk);
  p.before = plane_place(grid, u, v, plane);
  p.next = plane_place(grid, u, v, plane + 1.0f);
  return p;
}

static inline floatW plane_tau(const LightGrid* grid, __global const float* light_tau, const PlanePlace* at,
                               int first) {
  floatW a, b;
  lanes_gather2(light_tau + first, at->point, &a, &b);
  const floatW v0 = mad_exact(at->fu, b - a, a);
  lanes_gather2(light_tau + first + grid->nu, at->point, &a, &b);
  const floatW v1 = mad_exact(at->fu, b - a, a);
  return mad_exact(at->fv, v1 - v0, v0);
}

static inline int light_grid_first(const LightGrid* grid, int channel) {
  return grid->offset * TAU_CHANNELS + channel * grid->nu * grid->nv * grid->nk;
}

static inline floatW light_grid_tau(const LightGrid* grid, __global const float* light_tau, const LightGridPlace* at,
                                    int channel) {
  const int first = light_grid_first(grid, channel);
  const floatW before = plane_tau(grid, light_tau, &at->before, first);
  const floatW next = plane_tau(grid, light_tau, &at->next, first);
  return mad_exact(at->fk, next - before, before);
}

#endif
