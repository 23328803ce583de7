// The kernels of roofline.cl: limits of the device, and parts of walks alone.
#include <algorithm>

#include "cl/program.hpp"
#include "measure.hpp"
#include "render/device_scene.hpp"
#include "render/kernel_options.hpp"
#include "roofline_parts.hpp"
#include "roofline_texts.hpp"
#include "shared/method.h"

namespace brume::bench {

namespace {

constexpr std::size_t COPY_BYTES = 128 << 20;              // beyond the caches of most devices, and little memory
constexpr double LEAST_SECONDS = 0.05;                     // a run of a limit: longer than it takes to start
constexpr int LIMIT_RUNS = 5;                              // of which the best counts
constexpr std::size_t TABLE = 1024 + 3 * 256 + 1;          // of roofline_loads
constexpr double FLOPS_A_TURN = 2 * 12, LOADS_A_TURN = 4;  // of a lane, of an item: see roofline.cl

// The setting whose kernels are taken: cells, and a light grid to look at.
constexpr Setting SETTING{"", METHOD_DDA_MIDPOINT, 0, SHADOW_GRID, 64};

class Kernels {
 public:
  explicit Kernels(const RooflineBench& bench)
      : bench_(bench),
        flat_(flat_scene(bench.fog, SETTING, bench.lanes)),
        plan_(plan_of(bench.fog, SETTING, flat_)),
        channels_(flat_.color_tau ? 3 : 1),
        scene_(bench.context, flat_),
        planned_(bench.context, scene_, plan_, channels_),
        program_(program_build(bench.context, kernel_source_text(ROOFLINE_CL, "bench/roofline.cl"),
                               kernel_options(flat_, plan_, bench.context.device(), bench.lanes, false))) {}

  void limits() const;
  void walks() const;

 private:
  const RooflineBench& bench_;
  const FlatScene& flat_;
  const RenderPlan plan_;
  const int channels_;
  DeviceScene scene_;
  const DevicePlan planned_;
  const cl::Program program_;

  double run(const cl::Kernel& kernel, std::size_t items, const cl::NDRange& group) const;
  std::vector<double> runs(const cl::Kernel& kernel, std::size_t items, const cl::NDRange& group, int least = 1) const;
  void turned(const char* name, const char* item, double a_turn, cl::Kernel& kernel) const;
  void copied() const;
  double walked(const char* name, std::vector<double>& seconds) const;
};

double Kernels::run(const cl::Kernel& kernel, std::size_t items, const cl::NDRange& group) const {
  cl::Event event;
  const cl::CommandQueue& queue = bench_.context.queue();
  queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(items), group, nullptr, &event);
  queue.finish();
  return 1e-9 * static_cast<double>(event.getProfilingInfo<CL_PROFILING_COMMAND_END>() -
                                    event.getProfilingInfo<CL_PROFILING_COMMAND_START>());
}

// The first run is left out: it compiles, and memory is touched for the first time.
std::vector<double> Kernels::runs(const cl::Kernel& kernel, std::size_t items, const cl::NDRange& group,
                                  int least) const {
  run(kernel, items, group);
  std::vector<double> seconds(static_cast<std::size_t>(std::max(bench_.options.repetitions, least)));
  for (double& its : seconds) its = run(kernel, items, group);
  return seconds;
}

// As many turns as take a while.
void Kernels::turned(const char* name, const char* item, double a_turn, cl::Kernel& kernel) const {
  const DeviceInfo& device = bench_.context.device();
  const std::size_t items = static_cast<std::size_t>(device.compute_units) * (device.cpu ? 256 : 2048);
  const cl::Buffer out = bench_.context.buffer("roofline results", items * sizeof(float));
  kernel.setArg(2, out);
  cl_uint turns = 1;
  for (double seconds = 0; seconds < LEAST_SECONDS && turns < (1u << 30); turns *= 2) {
    kernel.setArg(0, 2 * turns);
    seconds = run(kernel, items, cl::NDRange(bench_.context.device().group));
  }
  bench_.add(name, item, a_turn * turns * static_cast<double>(items),
             runs(kernel, items, cl::NDRange(bench_.context.device().group), LIMIT_RUNS), cost_of(item));
}

void Kernels::copied() const {
  const std::vector<float> values(COPY_BYTES / sizeof(float), 1.0f);
  const cl::Buffer from = bench_.context.buffer("roofline copy", values),
                   to = bench_.context.buffer("roofline copy", COPY_BYTES);
  cl::Kernel kernel = kernel_create(program_, "roofline_copy");
  kernel.setArg(0, from);
  kernel.setArg(1, to);
  bench_.add("limit/copy", "copied byte", 2.0 * COPY_BYTES,
             runs(kernel, values.size() / static_cast<std::size_t>(bench_.lanes), cl::NullRange, LIMIT_RUNS),
             cost_of("copied byte"));
}

void Kernels::limits() const {
  copied();
  cl::Kernel fma = kernel_create(program_, "roofline_fma"), loads = kernel_create(program_, "roofline_loads");
  fma.setArg(1, 0.5f);
  turned("limit/fma", "flop", FLOPS_A_TURN * bench_.lanes, fma);
  const cl::Buffer table = bench_.context.buffer("roofline table", std::vector<float>(TABLE, 1.0f));
  loads.setArg(1, table);
  turned("limit/loads", "load", LOADS_A_TURN, loads);
}

// What the kernel has counted over the rays of the camera.
double Kernels::walked(const char* name, std::vector<double>& seconds) const {
  const std::size_t side = static_cast<std::size_t>(bench_.options.size), rays = side * side;
  std::vector<float> counted(2 * rays);
  const cl::Buffer out = bench_.context.buffer("roofline results", counted);
  cl::Kernel kernel = kernel_create(program_, name);
  cl_uint argument = planned_.set_arguments(kernel);
  kernel.setArg(argument++, static_cast<cl_uint>(rays));
  kernel.setArg(argument, out);
  const std::size_t groups = (rays + bench_.context.device().group - 1) / bench_.context.device().group;
  seconds = runs(kernel, groups * bench_.context.device().group, cl::NDRange(bench_.context.device().group));
  bench_.context.queue().enqueueReadBuffer(out, CL_TRUE, 0, counted.size() * sizeof(float), counted.data());
  double items = 0;
  for (std::size_t i = 0; i < rays; ++i) items += counted[2 * i];
  return items;
}

void Kernels::walks() const {
  std::vector<double> seconds;
  const double cells = walked("roofline_cells", seconds);
  bench_.add("cells", "cell", cells, seconds, cost_of("cell"));
  // Values that a filled grid could have, each in its own place of memory.
  const double points = static_cast<double>(plan_.light_entries) * channels_;
  bench_.context.queue().enqueueFillBuffer(planned_.light_tau(), 0.5f, 0,
                                           static_cast<std::size_t>(points) * sizeof(float));
  const double lookups = walked("roofline_light_grid", seconds);
  bench_.add("light_grid/lookups", "lookup", lookups, seconds,
             cost_of_reading(cost_of("light-grid lookup"), points * sizeof(float), lookups));
}

}  // namespace

void roofline_kernels(const RooflineBench& bench) {
  const Kernels kernels(bench);
  kernels.limits();
  kernels.walks();
}

}  // namespace brume::bench
