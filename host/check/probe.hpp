// Single device functions at work on arrays.
#pragma once
#include <cstdint>
#include <cstring>
#include <vector>

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

inline float bits_as_float(std::int32_t bits) {
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}
inline std::int32_t float_as_bits(float value) {
  std::int32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

}  // namespace brume
