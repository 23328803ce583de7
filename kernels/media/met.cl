// Which of W rays meet the box of a medium: many meet none, and that is soon said of all of them together.
#ifndef BRUME_MEDIA_MET_CL
#define BRUME_MEDIA_MET_CL
#include "density/medium.cl"

// Says in each hit what medium_ray() would say of a ray up to there.
static inline void media_met(const Scene* scene, int count, __global const Ray* rays, __global Hit* hits) {
  if (MEDIA_END(scene) == 0) return;
  float origin[3][W], dir[3][W], t_max[W], met[W];
  for (int i = 0; i < W; ++i) {
    const int its = min(i, count - 1);
    origin[0][i] = rays[its].origin.x;
    origin[1][i] = rays[its].origin.y;
    origin[2][i] = rays[its].origin.z;
    dir[0][i] = rays[its].dir.x;
    dir[1][i] = rays[its].dir.y;
    dir[2][i] = rays[its].dir.z;
    t_max[i] = hits[its].t;
  }
  const LaneVectors from = {{lanes_load(origin[0]), lanes_load(origin[1]), lanes_load(origin[2])}};
  const LaneVectors along = {{lanes_load(dir[0]), lanes_load(dir[1]), lanes_load(dir[2])}};
  floatW inside = (floatW)(0.0f);
  for (int m = 0; m < MEDIA_END(scene); ++m) {
    const Affine cell_from_world = scene->media[m].cell_from_world;
    const float3 lo = vec_unpack(scene->media[m].lo), hi = vec_unpack(scene->media[m].hi);
    const LaneVectors o = lanes_mapped(&cell_from_world, &from, 1), d = lanes_mapped(&cell_from_world, &along, 0);
    floatW t0 = (floatW)(0.0f), t1 = lanes_load(t_max);
    inside = lanes_select(inside, (floatW)(1.0f), lanes_box_cut(lo, hi, &o, &d, &t0, &t1));
  }
  lanes_store(inside, met);
  for (int i = 0; i < count; ++i) hits[i].in_media = met[i] > 0.0f;
}

#endif
