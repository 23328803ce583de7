// Random numbers as a pure function of (pixel, sample, dimension, seed) [Jarzynski20, pcg4d].
#ifndef BRUME_LIB_RNG_CL
#define BRUME_LIB_RNG_CL

static inline float rng_uniform(uint pixel, uint sample, uint dimension, uint seed) {
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
  x += y * w;
  return (float)(x >> 8) * 0x1p-24f;
}

#endif
