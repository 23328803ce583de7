// How much of a white sky reaches a surface: 1/π ∫ V cosθ over its hemisphere (PICTURE, Ambient occlusion).
#ifndef BRUME_PATH_AMBIENT_OCCLUSION_CL
#define BRUME_PATH_AMBIENT_OCCLUSION_CL
#include "lib/rng.cl"
#include "materials/surface.cl"

#define GOLDEN_TURN 2654435769u  // 2³² / Φ, Φ the golden ratio

// By how much of 2³² the directions of a sample are turned [Roberts18].
static inline uint occlusion_turn(__constant const Frame* frame, __global const Ray* ray) {
  if (!frame->occlusion_rotates) return 0;
  const uint x = ray->pixel % (uint)frame->camera.width, y = ray->pixel / (uint)frame->camera.width;
  return x * 3242174889u + y * 2447445414u + ray->sample * GOLDEN_TURN;
}

// Weights are summed too, so that nothing in the way is 1 to the last bit.
static inline float3 ambient_occlusion(const Scene* scene, __global const Ray* ray, const Surface* surface,
                                       __global SurfaceResult* result) {
  const int n = scene->frame->directions;
  const Frame3 frame = frame_about(surface->normal);
  uint turn = occlusion_turn(scene->frame, ray);
  float open = 0.0f, all = 0.0f;
  for (int i = 0; i < n; ++i, turn += GOLDEN_TURN) {
    const float cosine = 1.0f - (float)(2 * i + 1) / (float)(2 * n), sine = sqrt(1.0f - cosine * cosine);
    const float angle = 2.0f * PI_F * bits_uniform(turn);
    const float3 dir = cosine * frame.z + sine * (cos(angle) * frame.x + sin(angle) * frame.y);
    const int sees = dot(dir, surface->geometric_normal) > 0.0f &&
                     !scene_occluded(scene, surface_leave(surface, dir), dir, scene->frame->occlusion_reach);
    all += cosine;
    if (sees) open += cosine;
    result->lit = result->lit * 31u + (uint)sees;
  }
  result->shadow_rays = (uint)n;
  return (float3)(open / all);
}

#endif
