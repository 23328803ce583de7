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

void fill_gradients(Context& context, const DevicePlan& device_scene, const cl::Program& program,
                    const PlannedScene& scene) {
  cl::Kernel kernel = kernel_create(program, "probe_gradients");
  cl_uint argument = device_scene.set_arguments(kernel);
  const auto items = static_cast<cl_uint>(scene.gradient_bricks.size() * GRADIENT_ITEMS);
  kernel.setArg(argument++, items);
  kernel.setArg(argument++, device_scene.gradients());
  context.launch(kernel, items);
}

}  // namespace

std::vector<float> Probe::run(const char* name, const std::vector<float>& in, std::size_t in_stride,
                              std::size_t out_stride) const {
  const std::size_t count = in.size() / in_stride;
  std::vector<float> out(count * out_stride);
  const DriverGuard guard;
  try {
    DeviceScene uploaded(context_, scene_);
    const DevicePlan device_scene(context_, uploaded, scene_, 3);
    const cl::Program program = probe_program(context_, scene_, lanes_);
    if (uploaded.gradients_wanted(scene_.storage)) fill_gradients(context_, device_scene, program, scene_);
    cl::Kernel kernel = kernel_create(program, name);
    cl_uint argument = device_scene.set_arguments(kernel);
    const cl::Buffer in_buffer = context_.buffer("probe inputs", in),
                     out_buffer = context_.buffer("probe results", out);
    kernel.setArg(argument++, static_cast<cl_uint>(count));
    kernel.setArg(argument++, in_buffer);
    kernel.setArg(argument++, out_buffer);
    context_.launch(kernel, count);
    context_.queue().enqueueReadBuffer(out_buffer, CL_TRUE, 0, out.size() * sizeof(float), out.data());
  } catch (const cl::Error& error) {
    throw RuntimeError(context_.device().title() + ": " + name + ": " + error.what() +
                       " failed: " + cl_error_name(error.err()));
  }
  return out;
}

}  // namespace brume
