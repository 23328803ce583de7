// See device.hpp.
#include "cl/device.hpp"

#include <algorithm>
#include <cctype>

#include "base/error.hpp"
#include "base/foreign_lines.hpp"
#include "cl/driver_guard.hpp"

namespace brume {

namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

DeviceInfo device_describe(const cl::Platform& platform, const cl::Device& device, int index) {
  DeviceInfo info;
  info.index = index;
  info.device = device;
  info.platform = platform.getInfo<CL_PLATFORM_NAME>();
  info.name = device.getInfo<CL_DEVICE_NAME>();
  info.version = device.getInfo<CL_DEVICE_VERSION>();
  info.driver = device.getInfo<CL_DRIVER_VERSION>();
  info.cpu = (device.getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_CPU) != 0;
  info.fast_fma = (device.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>() & CL_FP_FMA) != 0;
  info.compute_units = static_cast<int>(device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>());
  info.float_width = static_cast<int>(device.getInfo<CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT>());
  info.memory_bytes = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
  info.max_buffer_bytes = device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
  info.max_group = device.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>();
  return info;
}

bool device_matches(const DeviceInfo& info, const std::string& wanted) {
  if (!wanted.empty() && std::all_of(wanted.begin(), wanted.end(), [](unsigned char c) { return std::isdigit(c); }))
    return wanted == std::to_string(info.index);
  return lower(info.name + " " + info.platform).find(lower(wanted)) != std::string::npos;
}

}  // namespace

int DeviceInfo::lanes() const {
  if (!cpu) return 1;
  return float_width >= 16 ? 16 : (float_width >= 8 ? 8 : 4);
}

std::vector<DeviceInfo> device_list() {
  driver_environment();
  const DriverGuard guard;
  const ForeignLines lines("an OpenCL driver");
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

DeviceInfo device_choose(const std::string& wanted) {
  const std::vector<DeviceInfo> devices = device_list();
  if (devices.empty()) {
    const std::string problem = kernel_cache_problem();  // PoCL has no devices then
    throw RuntimeError(
        "no OpenCL device found: " +
        (problem.empty() ? "install one (Debian: pocl-opencl-icd), and check OCL_ICD_VENDORS" : problem));
  }
  const std::string text = wanted.empty() ? "portable computing language" : wanted;
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
