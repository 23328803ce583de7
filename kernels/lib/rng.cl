// Random numbers as a pure function of (pixel, sample, dimension, seed) [Jarzynski20, pcg4d].
#ifndef BRUME_LIB_RNG_CL
#define BRUME_LIB_RNG_CL
#include "shared/frame.h"
#include "shared/random.h"
#include "shared/ray.h"

static inline uint rng_bits(uint pixel, uint sample, uint dimension, uint seed) {
  uint x = pixel * 1664525u + 1013904223u;
  uint y = sample * 1664525u + 1013904223u;
  uint z = dimension * 1664525u + 1013904223u;
  uint w = seed * 1664525u + 1013904223u;
  x += y * w;
  y += z * x;
  z += x * y;
  w += y * z;
  x ^= x >> 16;
  y ^= y >> 16;
  z ^= z >> 16;
  w ^= w >> 16;
  return x + y * w;
}

// The upper 24 bits as a number in [0,1).
static inline float bits_uniform(uint bits) { return (float)(bits >> 8) * 0x1p-24f; }

static inline float rng_uniform(uint pixel, uint sample, uint dimension, uint seed) {
  return bits_uniform(rng_bits(pixel, sample, dimension, seed));
}

// The random numbers of one walk. Streams form a tree: each ray, medium and light on the way has its own.
typedef struct {
  uint pixel, sample, seed;
} Random;

// Finaliser of MurmurHash3 [Appleby11].
static inline uint random_mix(uint h) {
  h = (h ^ (h >> 16)) * 0x85EBCA6Bu;
  h = (h ^ (h >> 13)) * 0xC2B2AE35u;
  return h ^ (h >> 16);
}

static inline Random random_stream(Random parent, uint id) {
  Random r = parent;
  r.seed = random_mix(parent.seed * 0x9E3779B1u + id + 1u);
  return r;
}

// Of a camera ray.
static inline Random random_begin(__constant const Frame* frame, uint pixel, uint sample) {
  Random r;
  r.pixel = pixel;
  r.sample = sample;
  r.seed = frame->seed;
  return r;
}

static inline Random ray_random(const Ray* ray) {
  const Random r = {ray->pixel, ray->sample, ray->seed};
  return r;
}

// `purpose`: RANDOM_x; `n`: the number of the segment.
static inline float random_at(const Random* r, uint n, uint purpose) {
  return rng_uniform(r->pixel, r->sample, n * RANDOM_PURPOSES + purpose, r->seed);
}

#endif
