// How much of a white sky reaches a surface (PICTURE, Ambient occlusion).
#pragma once
#include "reference/scatter.hpp"
#include "reference/surface.hpp"

namespace brume::reference {

struct Sky {
  double open = 0;  // 1/π ∫ V cosθ
  uint seen = 0;    // which directions see it, for the key of the pixel
};

// `random` is the ray's: of which pixel and sample it is.
Sky ambient_occlusion(const Context& context, const SurfaceD& surface, const RandomStream& random);

}  // namespace brume::reference
