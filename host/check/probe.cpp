// See probe.hpp.
#include "check/probe.hpp"

#include "base/error.hpp"
#include "cl/driver_guard.hpp"
#include "cl/program.hpp"
#include "render/device_scene.hpp"
#include "render/kernel_options.hpp"

namespace brume {

namespace {

// One program per set of options serves all probes: they only differ in the kernel they name.
cl::Program probe_program(const Context& context, const PlannedScene& scene, int lanes) {
  static const std::string source = kernel_source("probes/probes.cl");
  return program_build(context, source, kernel_options(scene, scene, context.device(), lanes, true));
}

}  // namespace

std::vector<float> Probe::run(const char* name, const std::vector<float>& in, std::size_t in_stride,
                              std::size_t out_stride) const {
  constexpr std::size_t group = 16;
  const std::size_t count = in.size() / in_stride;
  std::vector<float> out(count * out_stride);
  const DriverGuard guard;
  try {
    DeviceScene uploaded(context_, scene_);
    const DevicePlan device_scene(context_, uploaded, scene_, 3);
    cl::Kernel kernel = kernel_create(probe_program(context_, scene_, lanes_), name);
    cl_uint argument = device_scene.set_arguments(kernel);
    const cl::Buffer in_buffer = context_.buffer("probe inputs", in),
                     out_buffer = context_.buffer("probe results", out);
    kernel.setArg(argument++, static_cast<cl_uint>(count));
    kernel.setArg(argument++, in_buffer);
    kernel.setArg(argument++, out_buffer);
    context_.queue().enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange((count + group - 1) / group * group),
                                          cl::NDRange(group));
    context_.queue().enqueueReadBuffer(out_buffer, CL_TRUE, 0, out.size() * sizeof(float), out.data());
  } catch (const cl::Error& error) {
    throw RuntimeError(context_.device().title() + ": " + name + ": " + error.what() +
                       " failed: " + cl_error_name(error.err()));
  }
  return out;
}

}  // namespace brume
