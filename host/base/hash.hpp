// FNV-1a [Fowler91] over words of 64 bits: to tell apart what has changed, not what somebody has forged.
#pragma once
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace brume {

inline std::uint64_t hash_bytes(std::string_view bytes, std::uint64_t seed = 0) {
  constexpr std::uint64_t PRIME = 0x100000001b3u;
  std::uint64_t value = (0xcbf29ce484222325u ^ seed) * PRIME ^ bytes.size();
  for (std::size_t at = 0; at < bytes.size(); at += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + at, std::min(sizeof word, bytes.size() - at));
    value = (value ^ word) * PRIME;
    value ^= value >> 32;  // high bits of a word reach the low ones, as with single bytes
  }
  return value;
}

}  // namespace brume
