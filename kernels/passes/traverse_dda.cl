// What the media do to each ray between its origin and its hit: transmittance and in-scattered radiance. What a shape
// that refracts absorbs of what lies behind is part of the transmittance.
#include "materials/inside.cl"
#include "media/scatter.cl"

// Which of W rays meet the box of a medium, as medium_ray() would say of each: many meet none.
static inline void media_met(const Scene* scene, int count, __global const Ray* rays, __global const Hit* hits,
                             int* meets) {
  float origin[3][W], dir[3][W], t_max[W];
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
  floatW most = (floatW)(-1.0f);
  for (int m = 0; m < MEDIA_END(scene); ++m) {
    const Affine cell_from_world = scene->media[m].cell_from_world;
    const float3 lo = vec_unpack(scene->media[m].lo), hi = vec_unpack(scene->media[m].hi);
    const LaneVectors o = lanes_mapped(&cell_from_world, &from, 1), d = lanes_mapped(&cell_from_world, &along, 0);
    floatW t0 = (floatW)(0.0f), t1 = lanes_load(t_max);
    const intW inside = lanes_box_cut(lo, hi, &o, &d, &t0, &t1);
    most = lanes_select(most, (floatW)(1.0f), inside);
  }
  lanes_store(most, t_max);
  for (int i = 0; i < W; ++i) meets[i] = t_max[i] > 0.0f;
}

static inline MediumResult result_of(const Scene* scene, __global const Ray* its, float t, int meets) {
  const Ray ray = *its;
  MediumResult result;
  if (meets) {
    result = media_scatter(scene, vec_unpack(ray.origin), vec_unpack(ray.dir), t, ray_random(&ray));
  } else {
    result.transmittance = vec_pack((float3)(1.0f));
    result.radiance = vec_pack((float3)(0.0f));
    result.lookups = result.shadow_key = result.shadow_rays = 0;
    result.error = result.tau_error = 0.0f;
  }
#if BRUME_SPECULAR
  if (ray.inside[0] >= 0)
    result.transmittance =
        vec_pack(vec_unpack(result.transmittance) * inside_transmittance(scene, ray.inside, ray.start + t));
#endif
  return result;
}

// On a CPU the first of W items asks for all of them which see a medium.
__kernel void traverse_dda(SCENE_ARGS, uint count, __global const Ray* rays, __global const Hit* hits,
                           __global MediumResult* results) {
  const uint item = (uint)get_global_id(0);
  if (item >= count || item % W != 0) return;
  const Scene scene = SCENE_PACK;
  const int left = (int)min((uint)W, count - item);
  int meets[W];
  media_met(&scene, left, rays + item, hits + item, meets);
  for (int i = 0; i < left; ++i) results[item + i] = result_of(&scene, rays + item + i, hits[item + i].t, meets[i]);
}
