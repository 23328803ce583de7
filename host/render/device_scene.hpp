// A FlatScene on the device, as the leading arguments of every kernel that takes SCENE_ARGS (kernels/lib/scene.cl).
#pragma once
#include <array>

#include "cl/context.hpp"
#include "flat/flat_scene.hpp"
#include "shared/scene_buffers.h"

namespace brume {

// Names of the buffers, in the order of the arguments.
enum class SceneBuffer {
#define ROW(space, type, name, kind, member, what) name,
  BRUME_SCENE_BUFFERS(ROW, )
#undef ROW
      COUNT
};

class DeviceScene {
 public:
  // tau_channels: 3 where the kernels carry a colored τ (BRUME_COLOR_TAU), else 1.
  DeviceScene(Context& context, const FlatScene& scene, int tau_channels);

  const cl::Buffer& operator[](SceneBuffer buffer) const { return buffers_[static_cast<std::size_t>(buffer)]; }
  const cl::Buffer& light_tau() const { return (*this)[SceneBuffer::light_tau]; }

  // Sets the scene's arguments and returns the index of the kernel's first own argument.
  cl_uint set_arguments(cl::Kernel& kernel) const;

 private:
  std::array<cl::Buffer, static_cast<std::size_t>(SceneBuffer::COUNT)> buffers_;
};

}  // namespace brume
