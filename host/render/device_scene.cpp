// See device_scene.hpp.
#include "render/device_scene.hpp"

#include <type_traits>

#include "base/stopwatch.hpp"

namespace brume {

namespace {

// Whether kernels read brick_ranges: trackers for the rate of their collisions, liquids and isosurfaces for what is worth
// a look, voxels in bytes for their scale.
bool reads_ranges(const RenderPlan& plan, const FlatScene& flat) {
  return (plan.draws >> DRAWS_COLLISIONS) & 1u || plan.storage == STORAGE_U8 || !flat.liquids.empty() ||
         !flat.isosurfaces.empty();
}

template <class T>
cl::Buffer upload(Context& context, const char* what, const std::vector<T>& values) {
  return context.buffer(what, values);
}
cl::Buffer upload(Context& context, const char* what, const Frame& frame) {
  return context.buffer(what, sizeof frame, &frame);
}

template <class Member>
struct Element {
  using Type = Member;
};
template <class T>
struct Element<std::vector<T>> {
  using Type = T;
};

// Kernels and host mean the same elements.
#define ASSERT_FLAT(type, member) static_assert(std::is_same_v<Element<decltype(FlatScene::member)>::Type, type>);
#define ASSERT_PLAN(type, member) static_assert(std::is_same_v<Element<decltype(RenderPlan::member)>::Type, type>);
#define ASSERT_STORED(type, member)
#define ASSERT_SCRATCH(type, member)
#define ASSERT_JOINED(type, member)
#define ROW(space, type, name, kind, member, what) ASSERT_##kind(type, member)
BRUME_SCENE_BUFFERS(ROW, )
#undef ROW

constexpr const char* BUFFER_NAMES[] = {
#define ROW(space, type, name, kind, member, what) what,
    BRUME_SCENE_BUFFERS(ROW, )
#undef ROW
};
const char* name_of(SceneBuffer buffer) { return BUFFER_NAMES[static_cast<std::size_t>(buffer)]; }

cl::Buffer& at(SceneBuffers& buffers, SceneBuffer buffer) { return buffers[static_cast<std::size_t>(buffer)]; }

}  // namespace

DeviceScene::DeviceScene(Context& context, const FlatScene& scene) : context_(context), flat_(scene) {
  const Stopwatch watch;
#define UPLOAD_FLAT(name, member, what) at(buffers_, SceneBuffer::name) = upload(context, what, scene.member);
#define UPLOAD_PLAN(name, member, what)
#define UPLOAD_STORED(name, member, what)
#define UPLOAD_SCRATCH(name, member, what)
#define UPLOAD_JOINED(name, member, what)
#define ROW(space, type, name, kind, member, what) UPLOAD_##kind(name, member, what)
  BRUME_SCENE_BUFFERS(ROW, )
#undef ROW
#undef UPLOAD_FLAT
#undef UPLOAD_PLAN
  upload_seconds_ = watch.seconds();
}

DeviceScene::Stored& DeviceScene::stored(const RenderPlan& plan) {
  Stored& stored = stored_[plan.storage];
  const bool packs = plan.storage != STORAGE_F32 && !flat_.voxels.empty();
  if (packs && !stored.host) {
    std::vector<float> voxels = plan.stored ? std::vector<float>{} : flat_.voxels;
    stored.host =
        plan.stored ? plan.stored : std::make_shared<const StoredVoxels>(voxels_store(flat_, plan.storage, voxels));
  }
  if (!stored.voxels())
    stored.voxels = packs ? context_.buffer_over(name_of(SceneBuffer::voxels), stored.host->packed)
                          : context_.buffer_over(name_of(SceneBuffer::voxels), flat_.voxels);
  if (reads_ranges(plan, flat_) && !stored.ranges())
    stored.ranges = upload(context_, name_of(SceneBuffer::ranges), packs ? stored.host->ranges : flat_.brick_ranges);
  if (!stored.gradients()) {
    stored.gradients =
        context_.buffer(name_of(SceneBuffer::gradients),
                        4 * BRICK_VALUES * flat_.gradient_bricks.size() * voxel_bytes(plan.storage), nullptr);
    stored.has_gradients = flat_.gradient_bricks.empty();
  }
  return stored;
}

SceneBuffers DeviceScene::buffers(const RenderPlan& plan) {
  const Stored& its = stored(plan);
  SceneBuffers all = buffers_;
  at(all, SceneBuffer::voxels) = its.voxels;
  at(all, SceneBuffer::gradients) = its.gradients;
  at(all, SceneBuffer::ranges) =
      its.ranges() ? its.ranges : upload(context_, name_of(SceneBuffer::ranges), std::vector<float>{});
  return all;
}

DevicePlan::DevicePlan(Context& context, DeviceScene& scene, const RenderPlan& plan, int tau_channels)
    : buffers_(scene.buffers(plan)) {
#define UPLOAD_FLAT(name, member, what)
#define UPLOAD_PLAN(name, member, what) at(buffers_, SceneBuffer::name) = upload(context, what, plan.member);
#define ROW(space, type, name, kind, member, what) UPLOAD_##kind(name, member, what)
  BRUME_SCENE_BUFFERS(ROW, )
#undef ROW
  std::vector<Medium> media;
  for (std::size_t i = 0; i < plan.walks.size(); ++i) media.push_back(medium_of(scene.flat(), plan.walks[i], i));
  at(buffers_, SceneBuffer::media) = upload(context, name_of(SceneBuffer::media), media);
  at(buffers_, SceneBuffer::light_tau) =
      context.buffer(name_of(SceneBuffer::light_tau),
                     static_cast<std::size_t>(plan.light_entries * tau_channels) * sizeof(float), nullptr);
}

cl_uint DevicePlan::set_arguments(cl::Kernel& kernel) const {
  cl_uint argument = 0;
  for (const cl::Buffer& buffer : buffers_) kernel.setArg(argument++, buffer);
  return argument;
}

}  // namespace brume
