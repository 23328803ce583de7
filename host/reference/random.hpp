// Random numbers of walks: streams form a tree, each ray, medium and light on the way has its own (shared/random.h).
#pragma once
#include "reference/vec.hpp"
#include "shared/random.h"

namespace brume::reference {

struct RandomStream {
  uint pixel = 0, sample = 0, seed = 0;

  RandomStream child(uint id) const;
  // Uniform in [0,1): number `purpose` of segment n.
  double at(uint n, uint purpose) const;
};

}  // namespace brume::reference
