// Voxels in fewer bytes. What the reference and the ranges see is what devices read: rounding is an error of the data,
// never one between kernels and reference.
#include <Imath/half.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "plan/render_plan.hpp"

namespace brume {

namespace {

// Both return the largest |stored - given|. Densities are within half's range: densities_scale.
float pack_f16(std::vector<float>& voxels, StoredVoxels& stored) {
  for (float& value : stored.ranges) value = Imath::half(value);  // rounding keeps the order: still bounds
  stored.packed.resize(2 * voxels.size());
  float off = 0;
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    const float given = voxels[i];
    const Imath::half half(given);
    const std::uint16_t bits = half.bits();
    std::memcpy(&stored.packed[2 * i], &bits, sizeof bits);
    voxels[i] = half;
    off = std::max(off, std::abs(voxels[i] - given));
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

float pack_u8(std::vector<float>& voxels, StoredVoxels& stored) {
  stored.packed.resize(voxels.size());
  float off = 0;
  for (std::size_t brick = 0; brick < voxels.size() / BRICK_VALUES; ++brick)
    off = std::max(off, brick_pack_u8(stored.ranges[2 * brick], stored.ranges[2 * brick + 1],
                                      &voxels[brick * BRICK_VALUES], &stored.packed[brick * BRICK_VALUES]));
  return off;
}

}  // namespace

StoredVoxels voxels_store(const FlatScene& flat, int storage, std::vector<float>& voxels) {
  StoredVoxels stored;
  stored.ranges = flat.brick_ranges;
  if (voxels.empty()) return stored;
  const float largest = *std::max_element(voxels.begin(), voxels.end());
  stored.error = (storage == STORAGE_F16 ? pack_f16(voxels, stored) : pack_u8(voxels, stored)) / largest;
  return stored;
}

}  // namespace brume
