// One device in use: context, queue, buffers with their sizes checked and counted, errors with names.
#pragma once
#include <atomic>
#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "cl/device.hpp"

namespace brume {

// "CL_OUT_OF_RESOURCES (-5)"
std::string cl_error_name(int code);

class Context {
 public:
  explicit Context(const DeviceInfo& device);

  const DeviceInfo& device() const { return device_; }
  const cl::Context& cl() const { return context_; }
  const cl::CommandQueue& queue() const { return queue_; }
  // Of all buffers that still live, also those whose last use is under way.
  std::size_t allocated_bytes() const { return *allocated_; }

  // A buffer of `bytes` (at least 64: an empty array is a valid argument, and its first element may be read for
  // nothing), filled from `data` unless null.
  // Throws RuntimeError naming `what`, the size and what the device allows.
  // `in_place`: the buffer is `data`.
  cl::Buffer buffer(const char* what, std::size_t bytes, const void* data = nullptr, bool in_place = false);
  template <class T>
  cl::Buffer buffer(const char* what, const std::vector<T>& values) {
    return buffer(what, values.size() * sizeof(T), values.data());
  }
  // The same of data that live, unchanged, as long as the buffer: where the device's memory is the host's, they are
  // not copied.
  template <class T>
  cl::Buffer buffer_over(const char* what, const std::vector<T>& values) {
    // Oclgrind takes memory of the host for never written.
    const bool in_place = device_.cpu && device_.platform != "Oclgrind";
    return buffer(what, values.size() * sizeof(T), values.data(), in_place);
  }

  // One group at least: an empty launch compiles a kernel. Items of the last group beyond `items` run too, and have to
  // find nothing to do. Throws cl::Error.
  cl::Event launch(const cl::Kernel& kernel, std::size_t items) const;

  // Programs that were built in it, by text and options: program_build() looks here first.
  struct Built {
    cl::Program program;
    std::filesystem::path file;  // where it is to be kept (program_used); empty where it is, or is not to be
  };
  using Programs = std::map<std::pair<std::string, std::string>, Built>;
  Programs& programs() const { return programs_; }

 private:
  DeviceInfo device_;
  cl::Context context_;
  cl::CommandQueue queue_;
  mutable Programs programs_;
  // Shared: buffers may outlive the context, and die in threads of the driver.
  std::shared_ptr<std::atomic<std::size_t>> allocated_;
};

}  // namespace brume
