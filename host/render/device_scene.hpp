// A FlatScene on the device, as the leading arguments of every kernel that takes SCENE_ARGS (kernels/lib/scene.cl).
#pragma once
#include <vector>

#include "cl/context.hpp"
#include "flat/flat_scene.hpp"

namespace brume {

class DeviceScene {
 public:
  // The scene's voxels must live, unchanged, as long as this: a CPU reads them in place.
  // tau_channels: 3 where the kernels carry a colored τ (BRUME_COLOR_TAU), else 1.
  DeviceScene(Context& context, const FlatScene& scene, int tau_channels);

  const cl::Buffer& light_tau() const { return buffers_.back(); }

  // Sets the scene's arguments and returns the index of the kernel's first own argument.
  cl_uint set_arguments(cl::Kernel& kernel) const;

 private:
  std::vector<cl::Buffer> buffers_;  // in the order of SCENE_ARGS
};

}  // namespace brume
