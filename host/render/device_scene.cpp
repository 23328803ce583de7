// See device_scene.hpp.
#include "render/device_scene.hpp"

#include <type_traits>

namespace brume {

namespace {

// Trackers take their rates from the ranges, bytes their scale.
bool reads_ranges(const FlatScene& s) { return (s.draws >> DRAWS_COLLISIONS) & 1u || s.storage == STORAGE_U8; }

// What fills a buffer: of `data` null nothing does.
struct Contents {
  std::size_t bytes;
  const void* data;
};

template <class T>
Contents contents(const std::vector<T>& values) {
  return {values.size() * sizeof(T), values.data()};
}
Contents contents(const Frame& frame) { return {sizeof frame, &frame}; }

Contents stored_voxels(const FlatScene& s) { return s.packed.empty() ? contents(s.voxels) : contents(s.packed); }
Contents stored_brick_ranges(const FlatScene& s) {
  return reads_ranges(s) ? contents(s.brick_ranges) : Contents{0, nullptr};
}

Contents scratch_light_entries(const FlatScene& s, int tau_channels) {
  return {static_cast<std::size_t>(s.light_entries * tau_channels) * sizeof(float), nullptr};
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
#define ASSERT_STORED(type, member)
#define ASSERT_SCRATCH(type, member)
#define ROW(space, type, name, kind, member, what) ASSERT_##kind(type, member)
BRUME_SCENE_BUFFERS(ROW, )
#undef ROW

}  // namespace

DeviceScene::DeviceScene(Context& context, const FlatScene& s, int tau_channels){
#define FLAT_CONTENTS(member) contents(s.member)
#define STORED_CONTENTS(member) stored_##member(s)
#define SCRATCH_CONTENTS(member) scratch_##member(s, tau_channels)
#define ROW(space, type, name, kind, member, what)                                                           \
  {                                                                                                          \
    const Contents filled = kind##_CONTENTS(member);                                                         \
    buffers_[static_cast<std::size_t>(SceneBuffer::name)] = context.buffer(what, filled.bytes, filled.data); \
  }
    BRUME_SCENE_BUFFERS(ROW, )
#undef ROW
}

cl_uint DeviceScene::set_arguments(cl::Kernel& kernel) const {
  cl_uint argument = 0;
  for (const cl::Buffer& buffer : buffers_) kernel.setArg(argument++, buffer);
  return argument;
}

}  // namespace brume
