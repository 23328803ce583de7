// A FlatScene on the device, uploaded once, and one plan of it there: together the leading arguments of every kernel
// that takes SCENE_ARGS (kernels/lib/scene.cl).
#pragma once
#include <array>
#include <map>
#include <memory>

#include "cl/context.hpp"
#include "plan/render_plan.hpp"
#include "shared/scene_buffers.h"

namespace brume {

// Names of the buffers, in the order of the arguments.
enum class SceneBuffer {
#define ROW(space, type, name, kind, member, what) name,
  BRUME_SCENE_BUFFERS(ROW, )
#undef ROW
      COUNT
};
using SceneBuffers = std::array<cl::Buffer, static_cast<std::size_t>(SceneBuffer::COUNT)>;

inline std::size_t voxel_bytes(int storage) { return storage == STORAGE_F32 ? 4 : (storage == STORAGE_F16 ? 2 : 1); }

class DeviceScene {
 public:
  // `scene`, unchanged, and `context` outlive it: a CPU reads voxels in place.
  DeviceScene(Context& context, const FlatScene& scene);

  const FlatScene& flat() const { return flat_; }
  double upload_seconds() const { return upload_seconds_; }
  // The buffers of a plan, those of the plan's own left empty. Voxels, and ranges where they are read, are uploaded
  // when a storage is first asked for.
  SceneBuffers buffers(const RenderPlan& plan);
  // Whether gradients in a storage of which buffers() has been asked are still to be computed, by whoever has the kernel
  // for it.
  bool gradients_wanted(int storage) const { return !stored_.at(storage).has_gradients; }
  void gradients_done(int storage) { stored_.at(storage).has_gradients = true; }

 private:
  struct Stored {
    std::shared_ptr<const StoredVoxels> host;  // what the buffers lie over; null for f32
    cl::Buffer voxels, ranges, gradients;
    bool has_gradients = false;  // or nothing that has some
  };
  Stored& stored(const RenderPlan& plan);

  Context& context_;
  const FlatScene& flat_;
  SceneBuffers buffers_;
  std::map<int, Stored> stored_;  // by storage
  double upload_seconds_ = 0;
};

class DevicePlan {
 public:
  // tau_channels: 3 where the kernels carry a colored τ (BRUME_COLOR_TAU), else 1.
  DevicePlan(Context& context, DeviceScene& scene, const RenderPlan& plan, int tau_channels);

  const cl::Buffer& gradients() const { return buffers_[static_cast<std::size_t>(SceneBuffer::gradients)]; }
  const cl::Buffer& light_tau() const { return buffers_[static_cast<std::size_t>(SceneBuffer::light_tau)]; }

  // Sets the scene's arguments and returns the index of the kernel's first own argument.
  cl_uint set_arguments(cl::Kernel& kernel) const;

 private:
  SceneBuffers buffers_;
};

}  // namespace brume
