// See device.hpp.
#include "cl/device.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <optional>

#include "base/error.hpp"
#include "base/foreign_lines.hpp"
#include "cl/driver_guard.hpp"

namespace brume {

namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

// Private arrays of all items of a group lie on the worker's stack in PoCL: few items on a CPU.
constexpr std::size_t GROUP_CPU = 16, GROUP_GPU = 64;

// llvmpipe takes the items of a group side by side and mixes them up where they part ways: Mesa 22.3 itself warns that
// "results may be incorrect". Alone they are right.
std::size_t group_of(const DeviceInfo& info) {
  if (lower(info.name).find("llvmpipe") != std::string::npos) return 1;
  return std::min(info.cpu ? GROUP_CPU : GROUP_GPU, info.device.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>());
}

DeviceInfo device_describe(const cl::Platform& platform, const cl::Device& device, int index) {
  DeviceInfo info;
  info.index = index;
  info.device = device;
  info.platform = platform.getInfo<CL_PLATFORM_NAME>();
  info.platform_version = platform.getInfo<CL_PLATFORM_VERSION>();
  info.name = device.getInfo<CL_DEVICE_NAME>();
  info.version = device.getInfo<CL_DEVICE_VERSION>();
  info.driver = device.getInfo<CL_DRIVER_VERSION>();
  info.cpu = (device.getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_CPU) != 0;
  info.pocl_3_1 = info.platform_version.find("PoCL 3.1") != std::string::npos;
  info.fast_fma = (device.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>() & CL_FP_FMA) != 0;
  info.compute_units = static_cast<int>(device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>());
  info.float_width = static_cast<int>(device.getInfo<CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT>());
  info.memory_bytes = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
  info.max_buffer_bytes = device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
  info.group = group_of(info);
  return info;
}

bool device_matches(const DeviceInfo& info, const std::string& wanted) {
  if (!wanted.empty() && std::all_of(wanted.begin(), wanted.end(), [](unsigned char c) { return std::isdigit(c); }))
    return wanted == std::to_string(info.index);
  return lower(info.name + " " + info.platform).find(lower(wanted)) != std::string::npos;
}

// While one lives, the loader finds PoCL's driver alone: those of other vendors bring libraries that take longer to
// load than all else before the first call. Only where nobody has chosen drivers and PoCL can be loaded.
class PoclAlone {
 public:
  PoclAlone() : set_(possible()) {
    if (set_) ::setenv(VARIABLE, POCL, 0);
  }
  ~PoclAlone() {
    if (set_) ::unsetenv(VARIABLE);
  }
  PoclAlone(const PoclAlone&) = delete;
  PoclAlone& operator=(const PoclAlone&) = delete;

 private:
  static constexpr const char* VARIABLE = "OCL_ICD_VENDORS";
  static constexpr const char* POCL = "/etc/OpenCL/vendors/pocl.icd";

  static bool possible() {
    for (const char* choice : {VARIABLE, "OCL_ICD_FILENAMES", "OPENCL_VENDOR_PATH", "POCL_DEVICES", "LD_PRELOAD"})
      if (std::getenv(choice) != nullptr) return false;
    std::string library;
    std::ifstream file(POCL);
    std::getline(file, library);
    return !library.empty() && ::dlopen(library.c_str(), RTLD_LAZY) != nullptr;
  }

  bool set_;
};

// Only the first call in a process loads drivers.
std::vector<DeviceInfo> devices_find(bool pocl_alone) {
  driver_environment();
  const DriverGuard guard;
  const ForeignLines lines("an OpenCL driver");
  std::optional<PoclAlone> alone;
  if (pocl_alone) alone.emplace();
  std::vector<DeviceInfo> devices;
  std::vector<cl::Platform> platforms;
  try {
    cl::Platform::get(&platforms);
  } catch (const cl::Error&) {
    return devices;  // the loader reports "no platform" as an error
  }
  for (const cl::Platform& platform : platforms) {
    std::vector<cl::Device> found;
    try {
      platform.getDevices(CL_DEVICE_TYPE_ALL, &found);
      for (const cl::Device& device : found)
        devices.push_back(device_describe(platform, device, static_cast<int>(devices.size())));
    } catch (const cl::Error&) {
      continue;
    }
  }
  return devices;
}

}  // namespace

int DeviceInfo::lanes() const {
  if (!cpu) return 1;
  return float_width >= 16 ? 16 : (float_width >= 8 ? 8 : 4);
}

std::vector<DeviceInfo> device_list() { return devices_find(false); }

DeviceInfo device_choose(const std::string& wanted) {
  const std::vector<DeviceInfo> devices = devices_find(wanted.empty());
  if (devices.empty()) {
    const std::string problem = kernel_cache_problem();  // PoCL has no devices then
    throw RuntimeError("no OpenCL device found: " +
                       (problem.empty()
                            ? "install one (Debian: pocl-opencl-icd), or name one with --device (see brume devices), "
                              "and check OCL_ICD_VENDORS"
                            : problem));
  }
  const std::string text = wanted.empty() ? POCL_PLATFORM : wanted;
  for (const DeviceInfo& info : devices)
    if (device_matches(info, text)) return info;
  if (wanted.empty()) {
    const std::string problem = kernel_cache_problem();
    if (!problem.empty()) throw RuntimeError("the default device, PoCL's, is not there: " + problem);
    return devices.front();
  }
  std::string known;
  for (const DeviceInfo& info : devices)
    known += (known.empty() ? "" : "; ") + std::to_string(info.index) + " " + info.title();
  throw InputError("--device: no device matches '" + wanted + "'; known: " + known);
}

}  // namespace brume
