// Voxels in fewer bytes. What the reference and the ranges see is what devices read: rounding is an error of the data, never one
// between kernels and reference.
#include <Imath/half.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "flat/flatten_parts.hpp"

namespace brume {

namespace {

// Both return the largest |stored - given|. Densities are within half's range: densities_scale.
float pack_f16(FlatScene& scene) {
  for (float& value : scene.brick_ranges) value = Imath::half(value);  // rounding keeps the order: still bounds
  scene.packed.resize(2 * scene.voxels.size());
  float off = 0;
  for (std::size_t i = 0; i < scene.voxels.size(); ++i) {
    const float given = scene.voxels[i];
    const Imath::half half(given);
    const std::uint16_t bits = half.bits();
    std::memcpy(&scene.packed[2 * i], &bits, sizeof bits);
    scene.voxels[i] = half;
    off = std::max(off, std::abs(scene.voxels[i] - given));
  }
  return off;
}

// One brick: 255 parts of [min, max]. Samples beyond are those that no lookup reads (shared/medium.h).
float brick_pack_u8(float min, float max, float* voxels, unsigned char* codes) {
  const float part = (max - min) / 255.0f;
  float off = 0;
  for (int i = 0; i < BRICK_VALUES; ++i) {
    const float given = std::clamp(voxels[i], min, max);
    const float code = part > 0 ? std::round((given - min) / part) : 0.0f;
    codes[i] = static_cast<unsigned char>(code);
    voxels[i] = min + code * part;
    off = std::max(off, std::abs(voxels[i] - given));
  }
  return off;
}

float pack_u8(FlatScene& scene) {
  scene.packed.resize(scene.voxels.size());
  float off = 0;
  for (std::size_t brick = 0; brick < scene.voxels.size() / BRICK_VALUES; ++brick)
    off = std::max(off, brick_pack_u8(scene.brick_ranges[2 * brick], scene.brick_ranges[2 * brick + 1],
                                      &scene.voxels[brick * BRICK_VALUES], &scene.packed[brick * BRICK_VALUES]));
  return off;
}

}  // namespace

void voxels_pack(FlatScene& scene, int storage) {
  scene.storage = storage;
  if (storage == STORAGE_F32 || scene.voxels.empty()) return;
  const float largest = *std::max_element(scene.voxels.begin(), scene.voxels.end());
  scene.storage_error = (storage == STORAGE_F16 ? pack_f16(scene) : pack_u8(scene)) / largest;
}

}  // namespace brume
