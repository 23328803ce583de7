// How much memory a volume file may ask for.
#pragma once
#include <cstdint>

namespace brume {

// A leaf of OpenVDB takes at least 128 bytes in a file and 2.2 kB in memory. Beyond its share of these a file is
// damaged or made to harm.
inline std::uint64_t volume_memory_max(std::uint64_t file_bytes) { return (std::uint64_t{1} << 30) + 20 * file_bytes; }

}  // namespace brume
