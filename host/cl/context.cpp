// See context.hpp.
#include "cl/context.hpp"

#include <algorithm>
#include <array>

#include "base/error.hpp"
#include "cl/pocl_compiler.hpp"

namespace brume {

namespace {

std::string megabytes(std::size_t bytes) { return std::to_string((bytes + 1048575) / 1048576) + " MiB"; }

// Above this share of the device's memory the system starts to swap or kill: PoCL accepts more and fails later.
constexpr std::size_t LEAST_BYTES = 64;  // of a buffer
constexpr double MEMORY_SHARE = 0.8;

// What a buffer gives back when it dies.
struct Lent {
  std::shared_ptr<std::atomic<std::size_t>> allocated;
  std::size_t bytes;
};

void CL_CALLBACK give_back(cl_mem, void* data) {
  const std::unique_ptr<Lent> lent(static_cast<Lent*>(data));
  *lent->allocated -= lent->bytes;
}

// Counts the buffer until the driver frees it.
void count(cl::Buffer& buffer, const std::shared_ptr<std::atomic<std::size_t>>& allocated, std::size_t bytes) {
  auto lent = std::make_unique<Lent>(Lent{allocated, bytes});
  buffer.setDestructorCallback(give_back, lent.get());
  (void)lent.release();  // now the driver's, to be handed to give_back
  *allocated += bytes;
}

}  // namespace

std::string cl_error_name(int code) {
  struct Row {
    int code;
    const char* name;
  };
  static constexpr std::array<Row, 14> rows{{{CL_DEVICE_NOT_AVAILABLE, "CL_DEVICE_NOT_AVAILABLE"},
                                             {CL_COMPILER_NOT_AVAILABLE, "CL_COMPILER_NOT_AVAILABLE"},
                                             {CL_MEM_OBJECT_ALLOCATION_FAILURE, "CL_MEM_OBJECT_ALLOCATION_FAILURE"},
                                             {CL_OUT_OF_RESOURCES, "CL_OUT_OF_RESOURCES"},
                                             {CL_OUT_OF_HOST_MEMORY, "CL_OUT_OF_HOST_MEMORY"},
                                             {CL_BUILD_PROGRAM_FAILURE, "CL_BUILD_PROGRAM_FAILURE"},
                                             {CL_INVALID_VALUE, "CL_INVALID_VALUE"},
                                             {CL_INVALID_KERNEL_NAME, "CL_INVALID_KERNEL_NAME"},
                                             {CL_INVALID_KERNEL_ARGS, "CL_INVALID_KERNEL_ARGS"},
                                             {CL_INVALID_WORK_GROUP_SIZE, "CL_INVALID_WORK_GROUP_SIZE"},
                                             {CL_INVALID_BUFFER_SIZE, "CL_INVALID_BUFFER_SIZE"},
                                             {CL_INVALID_BUILD_OPTIONS, "CL_INVALID_BUILD_OPTIONS"},
                                             {CL_INVALID_ARG_SIZE, "CL_INVALID_ARG_SIZE"},
                                             {CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST, "CL_EXEC_STATUS_ERROR"}}};
  const auto row = std::find_if(rows.begin(), rows.end(), [code](const Row& r) { return r.code == code; });
  return (row == rows.end() ? std::string("OpenCL error") : std::string(row->name)) + " (" + std::to_string(code) + ")";
}

Context::Context(const DeviceInfo& device)
    : device_(device),
      context_(device.device),
      queue_(context_, device.device, CL_QUEUE_PROFILING_ENABLE),
      allocated_(std::make_shared<std::atomic<std::size_t>>(0)) {
  pocl_compiler_choose(device.pocl_3_1);
}

cl::Event Context::launch(const cl::Kernel& kernel, std::size_t items) const {
  const std::size_t group = device_.group, groups = std::max<std::size_t>((items + group - 1) / group, 1);
  cl::Event event;
  queue_.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(groups * group), cl::NDRange(group), nullptr, &event);
  return event;
}

cl::Buffer Context::buffer(const char* what, std::size_t bytes, const void* data, bool in_place) {
  const std::size_t size = std::max<std::size_t>(bytes, LEAST_BYTES);
  if (size > device_.max_buffer_bytes)
    throw RuntimeError(std::string(what) + ": " + megabytes(size) + " in one buffer are needed; " + device_.title() +
                       " allows " + megabytes(device_.max_buffer_bytes));
  const auto allowed = static_cast<std::size_t>(MEMORY_SHARE * static_cast<double>(device_.memory_bytes));
  if (*allocated_ + size > allowed)
    throw RuntimeError(std::string(what) + " bring the scene to " + megabytes(*allocated_ + size) + "; " +
                       device_.title() + " has room for " + megabytes(allowed));
  try {
    in_place = in_place && bytes == size && data != nullptr;
    cl::Buffer result(context_, in_place ? CL_MEM_READ_ONLY | CL_MEM_USE_HOST_PTR : CL_MEM_READ_WRITE, size,
                      in_place ? const_cast<void*>(data) : nullptr);
    if (!in_place && bytes > 0 && data != nullptr) queue_.enqueueWriteBuffer(result, CL_TRUE, 0, bytes, data);
    count(result, allocated_, size);
    return result;
  } catch (const cl::Error& error) {
    throw RuntimeError(std::string(what) + ": allocating " + megabytes(size) + " on " + device_.title() +
                       " failed: " + cl_error_name(error.err()));
  }
}

}  // namespace brume
