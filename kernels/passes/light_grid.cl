// Fills the light grid of one medium: the optical depth from each point to each light. Runs once, before the first batch.
#include "radiance/radiative.cl"

// True when a stored brick reaches into the box p ± reach (cell space): only then is the point ever looked up with a density.
static inline int bricks_near(const Scene* scene, const Medium* m, float3 p, float3 reach) {
  const float3 last = (float3)((float)(m->brick_nx - 1), (float)(m->brick_ny - 1), (float)(m->brick_nz - 1));
  const float3 lo = fmin(fmax(floor((p - reach) / BRICK_CELLS), (float3)(0.0f)), last);
  const float3 hi = fmin(fmax(floor((p + reach) / BRICK_CELLS), (float3)(0.0f)), last);
  for (int z = (int)lo.z; z <= (int)hi.z; ++z)
    for (int y = (int)lo.y; y <= (int)hi.y; ++y)
      for (int x = (int)lo.x; x <= (int)hi.x; ++x)
        if (scene->bricks[m->brick_offset + (z * m->brick_ny + y) * m->brick_nx + x] != BRICK_EMPTY) return 1;
  return 0;
}

// Item = point × light of one medium, points fastest.
__kernel void light_grid(SCENE_ARGS, int medium, uint count, __global float* out) {
  if ((uint)get_global_id(0) >= count) return;
  const Scene scene = SCENE_PACK;
  const Medium m = media[medium];
  const int points = light_grid_points(&m), light_index = (int)get_global_id(0) / points,
            i = (int)get_global_id(0) % points;
  const float3 lo = vec_unpack(m.lo), hi = vec_unpack(m.hi);
  const float3 spacing =
      (hi - lo) / (float3)((float)(m.light_nx - 1), (float)(m.light_ny - 1), (float)(m.light_nz - 1));
  const float3 at =
      (float3)((float)(i % m.light_nx), (float)(i / m.light_nx % m.light_ny), (float)(i / (m.light_nx * m.light_ny)));
  const float3 p = lo + spacing * at;
  tau_t tau = (tau_t)(0.0f);
  if (bricks_near(&scene, &m, p, spacing * 1.001f)) {
    const float3 point = affine_point(&m.world_from_cell, p);
    const LightSample light = light_sample(lights, light_index, point);
    uint lookups = 0;
    if (vec_max(light.irradiance) > 0.0f)
      tau = media_tau(&scene, -1, point, -light.travel, light.distance, random_begin(frame, (uint)i, (uint)light_index),
                      &lookups);
  }
#if BRUME_COLOR_TAU
  const float channels[3] = {tau.x, tau.y, tau.z};
#else
  const float channels[1] = {tau};
#endif
  for (int c = 0; c < TAU_CHANNELS; ++c)
    out[m.light_offset * TAU_CHANNELS + (c * frame->light_count + light_index) * points + i] = channels[c];
}
