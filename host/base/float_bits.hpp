// The bits of a float as an integer and back.
#pragma once
#include <cstdint>
#include <cstring>

namespace brume {

inline float bits_as_float(std::int32_t bits) {
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

inline std::int32_t float_as_bits(float value) {
  std::int32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

}  // namespace brume
