// Optical depth: of one medium or all, along shadow rays; collisions and roulette as changes of it.
#ifndef BRUME_MEDIA_TAU_CL
#define BRUME_MEDIA_TAU_CL
#include "walk/walk.cl"

// Optical depths: one float when every medium is grey, three else.
#if BRUME_COLOR_TAU
#define TAU_CHANNELS 3
typedef float3 Tau;
#define tau_min(v) vec_min(v)
#define tau_max(v) vec_max(v)
#define TAU_OF_COLOR(color) (color)
#define tau_channel(v, c) ((c) == 0 ? (v).x : ((c) == 1 ? (v).y : (v).z))
static inline Tau medium_sigma_t(const Medium* m) { return vec_unpack(m->sigma_a) + vec_unpack(m->sigma_s); }
#else
#define TAU_CHANNELS 1
typedef float Tau;
#define tau_min(v) (v)
#define tau_max(v) (v)
#define TAU_OF_COLOR(color) ((color).x)  // of three that are the same
#define tau_channel(v, c) (v)
static inline Tau medium_sigma_t(const Medium* m) { return m->sigma_a.x + m->sigma_s.x; }
#endif

#if BRUME_ROULETTE
// Once the transmittance is below the frame's threshold, a walk goes on with probability T / threshold and then counts
// for all those that were ended: T becomes the threshold. 0: the walk ends, *tau is black.
static inline int roulette_survives(const Scene* scene, const Random* walk, uint id, Tau* tau) {
  const float threshold = scene->frame->roulette;
  const float transmittance = exp(-tau_min(*tau));
  if (!(transmittance < threshold)) return 1;
  const float survival = transmittance / threshold;
  if (random_at(walk, id, RANDOM_ROULETTE) < survival) {
    *tau += log(survival);
    return 1;
  }
  *tau = (Tau)(TAU_BLACK);
  return 0;
}
#else
#define roulette_survives(scene, walk, id, tau) 1
#endif

#if BRUME_TRACKING
// What a tentative collision is worth.
typedef struct {
  float weight;  // estimate of ∫ρ; 0 where no light is asked for
  Tau before;    // τ up to it
} Collision;

// Collision i, of density · size = integral. Moves *tau past it.
//   ratio and residual ratio: T *= 1 - σt (ρ - low) / rate                                       [Novak14]
//   delta: real with probability p = σt ρ / rate of the strongest channel, and then the end; else each channel weighs
//   (1 - p_c) / (1 - p), which is 1 in a grey medium.
static inline Collision track_collide(const Medium* medium, const Random* walk, const Segments* at, int i,
                                      float integral, Tau sigma_t, Tau* tau) {
  Collision hit;
  *tau += sigma_t * at->control[i];
  hit.before = *tau;
  hit.weight = integral;
  const Tau p = fmin(sigma_t * fmax(integral - at->low[i] * at->size[i], 0.0f), (Tau)(1.0f));
  const float strongest = tau_max(p);
  if (METHOD_IS(medium, DELTA_TRACKING) && strongest > 0.0f) {
    if (random_at(walk, at->id[i], RANDOM_REAL) < strongest) {
      hit.weight /= strongest;
      *tau = (Tau)(TAU_BLACK);
      return hit;
    }
    hit.weight = 0.0f;
    *tau += log1p(-strongest) - log1p(-p);
  } else {
    const float asked = TRACK_LIGHTS * tau_max(sigma_t) * integral;
    if (asked > 0.0f && asked < 1.0f)
      hit.weight = random_at(walk, at->id[i], RANDOM_REAL) < asked ? integral / asked : 0.0f;
    *tau -= log1p(-p);
  }
  *tau = fmin(*tau, (Tau)(TAU_BLACK));
  return hit;
}

// τ of a medium by tracking: an estimate whose exp(-τ) is right in the mean.
static inline Tau track_tau(const Scene* scene, const Medium* medium, const MediumRay* ray, Random random, Tau sigma_t,
                            uint* lookups) {
  Walk walk = walk_begin(scene, medium, ray, random, WALK_TO_LIGHT);
  Segments at;
  float integral[W];
  Tau tau = (Tau)(0.0f);
  for (;;) {
    walk_next(scene, medium, ray, &walk, &at);
    if (at.count == 0) return tau;
    lanes_store(walk_integral(scene, medium, ray, &at), integral);
    for (int i = 0; i < at.count; ++i) {
      track_collide(medium, &random, &at, i, integral[i], sigma_t, &tau);
      *lookups += at.size[i] > 0.0f;
      if (!roulette_survives(scene, &random, at.id[i], &tau) || tau_min(tau) >= TAU_STOP)
        return fmin(tau, (Tau)(TAU_BLACK));
    }
  }
}
#endif

// Optical depth of medium m from the origin to t_max; `purpose` as in walk.cl.
static inline Tau medium_tau(const Scene* scene, int m, float3 origin, float3 dir, float t_max, Random random,
                             int purpose, uint* lookups) {
  const Medium medium = scene->media[m];
  const Tau sigma_t = medium_sigma_t(&medium);
  if (!(tau_max(sigma_t) > 0.0f)) return sigma_t;  // a medium that only glows
  const MediumRay ray = medium_ray(&medium, origin, dir, t_max);
  if (!(ray.length > 0.0f)) return (Tau)(0.0f);
  const Random walk = random_stream(random, (uint)m);
#if BRUME_TRACKING
  if (PLACEMENT_IS(&medium, COLLISIONS)) return track_tau(scene, &medium, &ray, walk, sigma_t, lookups);
#endif
  return sigma_t * walk_total(scene, &medium, &ray, walk, purpose, tau_min(sigma_t), lookups);
}

// Optical depth of all media but `except` from the origin to t_max, on the way to a light.
static inline Tau media_tau(const Scene* scene, int except, float3 origin, float3 dir, float t_max, Random random,
                            uint* lookups) {
  Tau tau = (Tau)(0.0f);
#if BRUME_MEDIA
  for (int m = 0; m < MEDIA_END(scene); ++m)
    if (m != except) tau += medium_tau(scene, m, origin, dir, t_max, random, WALK_TO_LIGHT, lookups);
#endif
  return tau;
}

static inline float3 media_transmittance(const Scene* scene, float3 origin, float3 dir, float t_max, Random random,
                                         uint* lookups) {
  return (float3)(1.0f) * exp(-media_tau(scene, -1, origin, dir, t_max, random, lookups));
}

#endif
