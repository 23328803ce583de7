// See device_scene.hpp.
#include "render/device_scene.hpp"

namespace brume {

namespace {

// Trackers take their rates from the ranges, bytes their scale.
bool reads_ranges(const FlatScene& s) { return (s.draws >> DRAWS_COLLISIONS) & 1u || s.storage == STORAGE_U8; }

}  // namespace

DeviceScene::DeviceScene(Context& context, const FlatScene& s, int tau_channels) {
  buffers_ = {
      context.buffer("frame", sizeof(Frame), &s.frame),
      context.buffer("lights", s.lights),
      context.buffer("materials", s.materials),
      context.buffer("textures", s.textures),
      context.buffer("texture pixels", s.texels),
      context.buffer("shapes", s.shapes),
      context.buffer("triangles", s.triangles),
      context.buffer("BVH nodes", s.bvh_nodes),
      context.buffer("BVH links", s.bvh_links),
      context.buffer("BVH triangles", s.bvh_blocks),
      context.buffer("BVH triangle numbers", s.bvh_ids),
      context.buffer("media", s.media),
      context.buffer("brick index", s.bricks),
      context.buffer("brick ranges", reads_ranges(s) ? s.brick_ranges : std::vector<float>{}),
      s.packed.empty() ? context.buffer_over("voxels", s.voxels) : context.buffer_over("voxels", s.packed),
      context.buffer("light grids", s.light_grids),
      context.buffer("light grid depths", static_cast<std::size_t>(s.light_entries * tau_channels) * sizeof(float)),
  };
}

cl_uint DeviceScene::set_arguments(cl::Kernel& kernel) const {
  cl_uint argument = 0;
  for (const cl::Buffer& buffer : buffers_) kernel.setArg(argument++, buffer);
  return argument;
}

}  // namespace brume
