// Fills a light grid by the maps of one medium: the optical depth from each point to each light. Runs once, before the
// first batch.
#include "media/radiative.cl"

// True when a stored brick reaches into the box p ± half_size (cell space): only then is the point ever looked up with
// a density.
static inline int bricks_near(const Scene* scene, const Medium* m, float3 p, float3 half_size) {
  const float3 last = (float3)((float)(m->brick_nx - 1), (float)(m->brick_ny - 1), (float)(m->brick_nz - 1));
  const float3 lo = fmin(fmax(floor((p - half_size) / BRICK_CELLS), (float3)(0.0f)), last);
  const float3 hi = fmin(fmax(floor((p + half_size) / BRICK_CELLS), (float3)(0.0f)), last);
  for (int z = (int)lo.z; z <= (int)hi.z; ++z)
    for (int y = (int)lo.y; y <= (int)hi.y; ++y)
      for (int x = (int)lo.x; x <= (int)hi.x; ++x)
        if (brick_entry(scene, m, x, y, z) != BRICK_EMPTY) return 1;
  return 0;
}

// Coordinate of a column in plane k, moved into the box.
static inline float light_grid_inside(int column, float slope, int k, int n, float margin, int* moved) {
  const float begin = slope * (float)k + margin, end = begin + (float)(n - 1) - 3.0f * margin;
  const float inside = clamp((float)column, begin + LIGHT_GRID_INSET, end - LIGHT_GRID_INSET);
  *moved |= inside != (float)column && slope != 0.0f;
  return inside;
}

// The box about one cell of the grid, in cell space.
static inline float3 light_grid_cell_size(const LightGrid* grid) {
  const float* m = grid->cell_from_grid.m;
  return (float3)(fabs(m[0]) + fabs(m[1]) + fabs(m[2]), fabs(m[4]) + fabs(m[5]) + fabs(m[6]),
                  fabs(m[8]) + fabs(m[9]) + fabs(m[10]));
}

// Item = column, of a light without columns = point. Of a column the first point in the box is traced to the light,
// each other one to the point before.
OUTLINED void light_grid_fill(const Scene* scene, int medium, int light_index, uint item, __global float* out) {
  const Medium m = scene->media[medium];
  const LightGrid grid = scene->light_grids[m.light_grids + light_index];
  const int columns = grid.columns_u * grid.columns_v, column = (int)item % columns;
  const int u = grid.first_u + column % grid.columns_u, v = grid.first_v + column / grid.columns_u;
  const int along = grid.column_step > 0.0f, planes = along ? grid.nk : 1;
  const float margin = along ? 1.0f : 0.0f;
  const Random random = random_begin(scene->frame, (uint)column, (uint)light_index);
  const float3 near = light_grid_cell_size(&grid) * 1.001f;
  Tau tau = (Tau)(0.0f);
  int known = 0;  // tau is that of the point before, behind which this one lies along the light
  uint lookups = 0;
  for (int i = 0; i < planes; ++i) {
    const int k = along ? (grid.from_first ? i : grid.nk - 1 - i) : (int)item / columns;
    const int iu = u - (int)floor(grid.slope_u * (float)k), iv = v - (int)floor(grid.slope_v * (float)k);
    if (iu < 0 || iu >= grid.nu || iv < 0 || iv >= grid.nv) {
      known = 0;
      continue;
    }
    int moved = 0;
    const float3 at = (float3)(light_grid_inside(u, grid.slope_u, k, grid.nu, margin, &moved),
                               light_grid_inside(v, grid.slope_v, k, grid.nv, margin, &moved), (float)k);
    const float3 p = affine_point(&grid.cell_from_grid, at), point = affine_point(&m.world_from_cell, p);
    const LightSample light = light_sample(scene, light_index, point, random);
    known = known && !moved;
    if (!known) tau = (Tau)(0.0f);
    // Points on which no other builds are left out where nothing is looked up.
    if (vec_max(light.irradiance) > 0.0f && ((along && !moved) || grid.media > 1 || bricks_near(scene, &m, p, near)))
      tau += media_tau(scene, -1, point, -light.travel, known ? grid.column_step : light.distance,
                       random_stream(random, (uint)k), &lookups);
    tau = fmin(tau, (Tau)(TAU_STOP));  // behind which walks end, sooner or later
    known = along && !moved;
#if BRUME_COLOR_TAU
    const float channels[3] = {tau.x, tau.y, tau.z};
#else
    const float channels[1] = {tau};
#endif
    for (int c = 0; c < TAU_CHANNELS; ++c)
      out[light_grid_first(&grid, c) + (k * grid.nv + iv) * grid.nu + iu] = channels[c];
  }
}

// Items [first, count) are those of this launch.
__kernel void light_grid(SCENE_ARGS, int medium, int light_index, uint first, uint count, __global float* out) {
  const uint item = first + (uint)get_global_id(0);
  if (item >= count) return;
  const Scene scene = SCENE_PACK;
  light_grid_fill(&scene, medium, light_index, item, out);
}
