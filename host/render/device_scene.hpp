// A FlatScene on the device, as the leading arguments of every kernel that takes SCENE_ARGS (kernels/lib/scene.cl).
#pragma once
#include <vector>

#include "cl/context.hpp"
#include "flat/flat_scene.hpp"

namespace brume {

class DeviceScene {
 public:
  DeviceScene(Context& context, const FlatScene& scene);

  // Sets the scene's arguments and returns the index of the kernel's first own argument.
  cl_uint set_arguments(cl::Kernel& kernel) const;

 private:
  std::vector<cl::Buffer> buffers_;  // in the order of SCENE_ARGS
};

}  // namespace brume
