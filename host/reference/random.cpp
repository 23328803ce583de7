// See random.hpp.
#include "reference/random.hpp"

#include "reference/sampling.hpp"

namespace brume::reference {

RandomStream RandomStream::child(uint id) const {
  // the finaliser of MurmurHash3 [Appleby11] over the parent's seed and the name of the child
  uint h = seed * 2654435761u + id + 1u;
  h ^= h >> 16;
  h *= 2246822507u;
  h ^= h >> 13;
  h *= 3266489909u;
  h ^= h >> 16;
  return {pixel, sample, h};
}

double RandomStream::at(uint n, uint purpose) const {
  return rng_uniform(pixel, sample, RANDOM_PURPOSES * n + purpose, seed);
}

}  // namespace brume::reference
