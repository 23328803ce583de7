// FNV-1a [Noll91] over words of 32 bits, of which all hashed structs consist: no padding.
#include "flat/scene_hash.hpp"

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
  return frame;
}

}  // namespace

std::uint64_t scene_hash(const FlatScene& scene) {
  Hash hash;
  hash.add(scene.origin);
  hash.add(scene.unit);
  hash.add(without_own_keys(scene.frame));
  hash.add(scene.lights);
  hash.add(scene.light_shares);
  hash.add(scene.materials);
  hash.add(scene.textures);
  hash.add(scene.texels);
  hash.add(scene.shapes);
  hash.add(scene.triangles);
  hash.add(scene.media);
  hash.add(scene.bricks);
  hash.add(scene.brick_ranges);
  hash.add(scene.voxels);
  hash.add(scene.storage);
  hash.add(scene.light_grids);
  hash.add(scene.method);
  return hash.value();
}

}  // namespace brume
