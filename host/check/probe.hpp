// Single device functions at work on arrays.
#pragma once
#include <vector>

#include "base/float_bits.hpp"
#include "cl/context.hpp"
#include "plan/render_plan.hpp"

namespace brume {

// Runs one probe kernel (kernels/probes/probes.cl) over in.size() / in_stride items; of each out_stride floats come
// back. Throws RuntimeError with device, kernel and OpenCL's cause.
class Probe {
 public:
  Probe(Context& context, const PlannedScene& scene, int lanes) : context_(context), scene_(scene), lanes_(lanes) {}
  std::vector<float> run(const char* kernel, const std::vector<float>& in, std::size_t in_stride,
                         std::size_t out_stride) const;

 private:
  Context& context_;
  const PlannedScene& scene_;
  int lanes_;
};

}  // namespace brume
