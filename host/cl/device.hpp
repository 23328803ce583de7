// Which OpenCL devices there are, what they can do, and which one to use.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "cl/opencl.hpp"

namespace brume {

inline constexpr const char* POCL_PLATFORM = "Portable Computing Language";

struct DeviceInfo {
  int index;  // over all platforms, in the loader's order
  cl::Device device;
  std::string platform, platform_version, name, version, driver;
  bool cpu;
  bool fast_fma;
  bool pocl_3_1;  // of whose compiler some things are known (pocl_compiler.hpp)
  int compute_units;
  int float_width;  // native vector width in floats
  std::size_t memory_bytes, max_buffer_bytes;
  std::size_t group;  // items of a work-group

  int lanes() const;  // 4, 8 or 16 on a CPU by its vector width, 1 elsewhere
  std::string title() const { return name + " (" + platform + ")"; }
};

// Every device of every platform; platforms that fail or are empty are passed over.
std::vector<DeviceInfo> device_list();

// `wanted`: an index, or part of a device's or platform's name (case ignored); empty: PoCL's CPU, else the first
// device. Throws InputError with the list for an unknown one, RuntimeError when there is no device at all.
DeviceInfo device_choose(const std::string& wanted);

}  // namespace brume
