// See check.hpp: error bookkeeping, running probes, the order of the checks. Images: check_images.cpp.
#include "check/check.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/interrupt.hpp"
#include "check/check_images.hpp"
#include "check/check_parts.hpp"
#include "cl/driver_guard.hpp"
#include "cl/program.hpp"
#include "render/device_scene.hpp"
#include "render/kernel_options.hpp"

namespace brume {

bool CheckRow::passed() const {
  const double edges_allowed = std::max(1.0, EDGE_SHARE * static_cast<double>(items));
  return items > 0 && max_error <= allowed.limit && static_cast<double>(edges) <= edges_allowed;
}

ErrorSum::ErrorSum(std::string name, int lanes, std::string_view tolerance_name) {
  row_.name = std::move(name);
  row_.lanes = lanes;
  row_.allowed = tolerance(tolerance_name);
}

double ErrorSum::error(double kernel, double reference) const {
  if (kernel == reference) return 0;  // infinities of one sign included
  const double e = std::abs(kernel - reference) / (std::abs(reference) + row_.allowed.floor);
  return std::isfinite(e) ? e : INFINITY;  // a NaN on either side is an infinite error
}

bool ErrorSum::agrees(double kernel, double reference) const { return error(kernel, reference) <= row_.allowed.limit; }

void ErrorSum::add(double kernel, double reference) {
  const double e = error(kernel, reference);
  row_.max_error = std::max(row_.max_error, e);
  sum_ += e;
  ++row_.items;
}

CheckRow ErrorSum::row() const {
  CheckRow row = row_;
  row.mean_error = row.items > 0 ? sum_ / static_cast<double>(row.items) : 0;
  return row;
}

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

std::vector<CheckRow> check_run(Context& context, const CheckOptions& options,
                                const std::function<void(const CheckRow&)>& report) {
  std::vector<CheckRow> rows;
  const auto take = [&](const std::vector<CheckRow>& found) {
    for (const CheckRow& row : found) {
      if (row.name.find(options.filter) == std::string::npos) continue;
      rows.push_back(row);
      report(row);
    }
  };
  for (const FunctionCheckRow& check : function_checks()) {
    // A filter that names no row of this check spares its work; "image" never begins a function check.
    const std::string name = check.name;
    const std::string head = options.filter.substr(0, options.filter.find('/'));
    if (!head.empty() && name.find(head) == std::string::npos) continue;
    for (const int lanes : options.lanes) {
      interrupt_check();
      take(check.run(context, lanes, options.size * options.size));
    }
  }
  for (const std::string& scene : check_scene_names())
    if (("image/" + scene).find(options.filter) != std::string::npos)
      take(check_image(context, scene, options.size, options.lanes));
  return rows;
}

}  // namespace brume
