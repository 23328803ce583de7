// All media along a view ray: what they scatter towards its origin, and the transmittance through them.
#ifndef BRUME_MEDIA_SCATTER_CL
#define BRUME_MEDIA_SCATTER_CL
#include "media/liquid.cl"
#include "media/together.cl"

// `adaptive` joins others where it does not ask for light by runs of its own, nor in steps through a constant medium,
// and where its segments are asked, which tells its error.
static inline int adaptive_joins(__global const Medium* medium) {
  const int scatters = vec_max(vec_unpack(medium->sigma_s)) > 0.0f;
  if (medium->is_constant || (scatters && medium->light_grids < 0)) return 0;
  return scatters || vec_max(vec_unpack(medium->emission)) > 0.0f;
}

// Roulette and trackers change τ as their random numbers say, which nobody but the medium itself may see.
static inline int walks_together(const Scene* scene) {
  if (BRUME_MEDIA < 3 || !TAKES_ENDS(scene) || (BRUME_ROULETTE && scene->frame->roulette > 0.0f)) return 0;
  for (int m = 0; USES_METHOD(ADAPTIVE) && m < MEDIA_END(scene); ++m)
    if (METHOD_IS(scene->media + m, ADAPTIVE) && !adaptive_joins(scene->media + m)) return 0;
  return 1;
}

// A medium that only weakens what is behind it needs no places for light, and nobody asks what the others do along it.
// Random walks go the same way as ever, and `adaptive` tells its error.
static inline int medium_only_absorbs(__global const Medium* medium) {
  return !BRUME_ROULETTE && !PLACEMENT_IS(medium, COLLISIONS) && !METHOD_IS(medium, ADAPTIVE) &&
         !(vec_max(vec_unpack(medium->sigma_s)) > 0.0f || vec_max(vec_unpack(medium->emission)) > 0.0f);
}

// Of a ray that meets no medium.
static inline MediumResult medium_result_none(void) {
  MediumResult result;
  result.transmittance = vec_pack((float3)(1.0f));
  result.radiance = vec_pack((float3)(0.0f));
  result.lookups = 0;
  result.shadow_key = 0;
  result.shadow_rays = 0;
  result.error = result.tau_error = 0.0f;
  return result;
}

// All media along a view ray.
OUTLINED MediumResult media_scatter(const Scene* scene, float3 origin, float3 dir, float t_max, Random random) {
  MediumResult result = medium_result_none();
  const int together = walks_together(scene);
  LongSum radiance = {(float3)(0.0f), (float3)(0.0f)};
  Tau tau = (Tau)(0.0f);
#if BRUME_MEDIA >= 3
  for (int m = 0; together && m < MEDIA_END(scene);)
    tau += media_scatter_together(scene, &m, origin, dir, t_max, random, &radiance, &result);
#endif
#if BRUME_MEDIA
#if BRUME_LIQUID
  for (int m = 0; m < MEDIA_END(scene); ++m) {
    if (!RULE_IS(scene->media + m, LINEAR)) continue;
    const Tau own = liquid_scatter(scene, m, origin, dir, t_max, random, &radiance, &result);
    if (!together) tau += own;
  }
#endif
  for (int m = 0; !together && m < MEDIA_END(scene); ++m) {
    if (RULE_IS(scene->media + m, LINEAR)) continue;
    tau += medium_only_absorbs(scene->media + m)
               ? medium_tau(scene, m, origin, dir, t_max, random, WALK_SEEN, &result.lookups)
               : medium_scatter(scene, m, origin, dir, t_max, random, &radiance, &result);
  }
#endif
  result.transmittance = vec_pack((float3)(1.0f) * exp(-tau));
  result.radiance = vec_pack(radiance.sum);
  return result;
}

#endif
