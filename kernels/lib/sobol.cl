// The first two dimensions of Sobol's sequence [Sobol67], scrambled [Owen95] by a hash [Burley20] [Vegdahl21]. Every
// number has its bits reversed, lowest bit first behind the binary point: a hash can then only carry towards finer
// digits, and both dimensions begin with the index as it is.
#ifndef BRUME_LIB_SOBOL_CL
#define BRUME_LIB_SOBOL_CL
#include "lib/rng.cl"

static inline uint bits_reverse(uint x) {
  x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
  x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
  x = ((x >> 4) & 0x0F0F0F0Fu) | ((x & 0x0F0F0F0Fu) << 4);
  x = ((x >> 8) & 0x00FF00FFu) | ((x & 0x00FF00FFu) << 8);
  return (x >> 16) | (x << 16);
}

// Point `index` in dimension 1. Digit r is the sum modulo 2 of the bits k of the index for which C(k, r) is odd: by
// Lucas' theorem those whose k has every bit of r, so one step for each bit of k sums them all.
static inline uint sobol_reversed(uint index) {
  uint x = index;
  x ^= (x >> 1) & 0x55555555u;
  x ^= (x >> 2) & 0x33333333u;
  x ^= (x >> 4) & 0x0F0F0F0Fu;
  x ^= (x >> 8) & 0x00FF00FFu;
  return x ^ (x >> 16);
}

// Flips each digit by a hash of the seed and the digits before it: a product with an even number reaches only later
// ones.
static inline uint owen_scramble_reversed(uint x, uint seed) {
  x ^= x * 0x3D20ADEAu;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526C56u;
  return x ^ (x * 0x53A22864u);
}

// Point `index` in both dimensions, in [0, 1), scrambled by two hashes.
static inline float2 sobol_scrambled(uint index, uint pixel, uint sample, uint seed) {
  const uint x = owen_scramble_reversed(index, rng_bits(pixel, sample, 0, seed));
  const uint y = owen_scramble_reversed(sobol_reversed(index), rng_bits(pixel, sample, 1, seed));
  return (float2)(bits_uniform(bits_reverse(x)), bits_uniform(bits_reverse(y)));
}

#endif
