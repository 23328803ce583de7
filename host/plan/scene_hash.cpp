// FNV-1a [Fowler91] over words of 32 bits, of which all hashed structs consist: no padding.
#include "plan/scene_hash.hpp"

#include <cstddef>
#include <cstring>
#include <type_traits>

namespace brume {

namespace {

class Hash {
 public:
  void add(const void* data, std::size_t words) {
    const char* at = static_cast<const char*>(data);
    for (std::size_t i = 0; i < words; ++i) {
      std::uint32_t word;
      std::memcpy(&word, at + i * sizeof word, sizeof word);
      value_ = (value_ ^ word) * 0x100000001b3u;
      value_ ^= value_ >> 32;  // high bits of a word reach the low ones, as with single bytes
    }
  }
  template <class T>
  void add(const T& value) {
    static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % 4 == 0);
    add(&value, sizeof(T) / 4);
  }
  template <class T>
  void add(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % 4 == 0);
    add(std::uint64_t(values.size()));
    add(values.data(), values.size() * (sizeof(T) / 4));
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

Frame without_own_keys(Frame frame) {
  frame.crop_x0 = frame.crop_y0 = frame.crop_x1 = frame.crop_y1 = 0;
  frame.camera.width = frame.camera.height = frame.camera.spp = 0;
  frame.seed = 0;
  frame.instance_root = frame.shape_root = frame.list_count = 0;  // how shapes are found, which hangs on the lanes
  return frame;
}

Instance without_root(Instance instance) {
  instance.root = 0;
  return instance;
}

}  // namespace

std::uint64_t scene_hash(const PlannedScene& scene) {
  // All fields by name, so that a new one does not compile until it is decided here.
  const auto& [origin, unit, bounds, light_sources, materials, textures, texels, shapes, shape_list, shape_root,
               isosurfaces, iso_masks, triangles, meshes, instances, instance_root, bvh_width, bvh_rule, bvh_nodes,
               bvh_blocks, grids, placed, media, liquids, gradient_bricks, sizes, bricks, brick_ranges, voxels,
               color_tau, name, notes] = static_cast<const FlatScene&>(scene);
  const auto& [frame, lights, light_shares, walks, draws, piece_rates, light_grids, light_entries, storage, stored,
               plan_notes] = static_cast<const RenderPlan&>(scene);
  Hash hash;
  hash.add(origin);
  hash.add(unit);
  hash.add(without_own_keys(frame));
  hash.add(lights);
  hash.add(light_shares);
  hash.add(materials);
  hash.add(textures);
  hash.add(texels);
  hash.add(shapes);
  hash.add(isosurfaces);
  hash.add(triangles);
  hash.add(meshes);
  hash.add(std::uint64_t(instances.size()));
  for (const Instance& instance : instances) hash.add(without_root(instance));
  hash.add(grids);
  hash.add(placed);
  hash.add(media);
  hash.add(liquids);
  hash.add(walks);
  hash.add(bricks);
  hash.add(brick_ranges);
  hash.add(voxels);
  hash.add(piece_rates);
  hash.add(storage);
  hash.add(light_grids);
  return hash.value();
}

}  // namespace brume
