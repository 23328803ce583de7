// See passes.hpp. The order of arguments follows kernels/passes/*.cl.
#include "render/passes.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "cl/driver_guard.hpp"
#include "cl/program.hpp"
#include "render/kernel_options.hpp"
#include "render/pace.hpp"
#include "shared/ray.h"

namespace brume {

namespace {

constexpr const char* PASS_NAMES[] = {"primary_rays", "traverse_dda",   "shadow_transmittance",
                                      "shade",        "secondary_rays", "accumulate"};

// One program for all passes: the front end reads the shared text once.
std::string passes_source() {
  std::string text;
  for (const char* name : PASS_NAMES) text += std::string("#include \"passes/") + name + ".cl\"\n";
  text += "#include \"passes/light_grid.cl\"\n";
  return kernel_source_text(text, "passes");
}

// Private arrays of all items of a group lie on the worker's stack in PoCL: few items on a CPU.
constexpr std::size_t GROUP_CPU = 16, GROUP_GPU = 64;

constexpr std::size_t PIECE_FIRST = 512;  // of a light grid

double event_seconds(const cl::Event& event) {
  return 1e-9 * static_cast<double>(event.getProfilingInfo<CL_PROFILING_COMMAND_END>() -
                                    event.getProfilingInfo<CL_PROFILING_COMMAND_START>());
}

}  // namespace

Passes::Passes(Context& context, std::shared_ptr<DeviceScene> device_scene, const RenderPlan& plan,
               const std::string& options, int tau_channels, std::size_t batch_rays, std::size_t film_pixels)
    : context_(context),
      device_scene_(std::move(device_scene)),
      scene_(context, *device_scene_, plan, tau_channels),
      has_surfaces_(!device_scene_->flat().shapes.empty() || !device_scene_->flat().triangles.empty()),
      has_specular_(has_surfaces_ && plan.frame.max_depth > 0 && scene_is_specular(device_scene_->flat())),
      film_pixels_(film_pixels),
      group_(std::min(context.device().cpu ? GROUP_CPU : GROUP_GPU, context.device().max_group)) {
  create_buffers(batch_rays, device_scene_->flat().lights.size());
  plan_light_grids(device_scene_->flat(), plan);
  upload_seconds_ = watch_.lap();
  create_kernels(options);
  // PoCL compiles a kernel at its first launch: an empty batch moves that out of the render time.
  std::vector<PassStats> unused;
  run({0, 0, 0, 1}, unused);
  build_seconds_ = watch_.lap();
}

void Passes::plan_light_grids(const FlatScene& scene, const RenderPlan& plan) {
  for (std::size_t m = 0; m < scene.media.size(); ++m)
    for (std::size_t l = 0; plan.walks[m].light_grids >= 0 && l < scene.lights.size(); ++l) {
      const LightGrid& grid = plan.light_grids[static_cast<std::size_t>(plan.walks[m].light_grids) + l];
      const int items = grid.columns_u * grid.columns_v * (grid.reach > 0 ? 1 : grid.nk);
      light_grids_.push_back({static_cast<cl_int>(m), static_cast<cl_int>(l), 0, static_cast<cl_uint>(items)});
    }
}

void Passes::create_buffers(std::size_t batch_rays, std::size_t lights) {
  rays_ = context_.buffer("rays", batch_rays * sizeof(Ray));
  hits_ = context_.buffer("hits", batch_rays * sizeof(Hit));
  results_ = context_.buffer("media results", batch_rays * sizeof(MediumResult));
  arrivals_ = context_.buffer("light arrivals", has_surfaces_ ? batch_rays * lights * sizeof(LightArrival) : 0);
  samples_ = context_.buffer("samples", batch_rays * sizeof(Sample));
  film_ = context_.buffer("the film", film_pixels_ * sizeof(FilmPixel));
  context_.queue().enqueueFillBuffer(film_, cl_uint(0), 0, film_pixels_ * sizeof(FilmPixel));
}

void Passes::create_kernels(const std::string& options) {
  const cl::Program program = program_build(context_, passes_source(), options);
  for (int id = 0; id < PASS_COUNT; ++id) {
    if (!runs(static_cast<Id>(id))) continue;
    kernels_[id] = kernel_create(program, PASS_NAMES[id]);
    first_argument_[id] = id == ACCUMULATE ? 0 : scene_.set_arguments(kernels_[id]);
  }
  if (light_grids_.empty()) return;
  light_grid_kernel_ = kernel_create(program, "light_grid");
  launch_light_grid({0, 0, 0, 0});  // compiled now, not during the render
}

// Sets every pass's own arguments.
void Passes::bind(const Batch& batch) {
  const cl_uint rays = batch.rays();
  const auto set = [this](Id id, const auto&... values) {
    cl_uint argument = first_argument_[id];
    if (runs(id)) (kernels_[id].setArg(argument++, values), ...);
  };
  set(PRIMARY_RAYS, batch.first_pixel, batch.first_sample, batch.samples, rays, rays_, hits_);
  set(TRAVERSE_DDA, rays, rays_, hits_, results_);
  set(SHADOW_TRANSMITTANCE, rays, rays_, hits_, results_, arrivals_);
  set(SHADE, rays, rays_, hits_, results_, arrivals_, samples_);
  set(SECONDARY_RAYS, rays, rays_, hits_, results_, samples_);
  set(ACCUMULATE, batch.first_pixel, batch.pixels, batch.first_sample, batch.samples, hits_, results_, samples_, film_);
}

cl::Event Passes::launch(const cl::Kernel& kernel, std::size_t items) {
  cl::Event event;
  const std::size_t groups = std::max<std::size_t>((items + group_ - 1) / group_, 1);
  context_.queue().enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(groups * group_), cl::NDRange(group_),
                                        nullptr, &event);
  return event;
}

cl::Event Passes::launch_light_grid(const LightGridWork& work) {
  cl_uint argument = scene_.set_arguments(light_grid_kernel_);
  light_grid_kernel_.setArg(argument++, work.medium);
  light_grid_kernel_.setArg(argument++, work.light);
  light_grid_kernel_.setArg(argument++, work.first);
  light_grid_kernel_.setArg(argument++, work.first + work.items);
  light_grid_kernel_.setArg(argument++, scene_.light_tau());
  const cl::Event event = launch(light_grid_kernel_, work.items);
  event.wait();
  return event;
}

double Passes::light_grid_items() const {
  double items = 0;
  for (const LightGridWork& grid : light_grids_) items += grid.items;
  return items;
}

void Passes::fill_light_grid(const LightGridWork& grid, PassStats& pass, bool& stopped,
                             const std::function<bool(double)>& go_on) {
  Pace pace(PIECE_FIRST, grid.items);
  for (cl_uint first = 0; first < grid.items && !stopped;) {
    const cl_uint items = std::min(static_cast<cl_uint>(pace.next()), grid.items - first);
    const double seconds = event_seconds(launch_light_grid({grid.medium, grid.light, first, items}));
    pace.took(items, seconds);
    pass.seconds += seconds;
    pass.items += items;
    first += items;
    stopped = !go_on(pass.items);
  }
}

void Passes::fill_light_grids(std::vector<PassStats>& stats, const std::function<bool(double)>& go_on) {
  if (light_grids_.empty()) return;
  PassStats pass{"light_grid", 0, 0};
  bool stopped = false;
  try {
    for (const LightGridWork& grid : light_grids_) fill_light_grid(grid, pass, stopped, go_on);
  } catch (const cl::Error& error) {
    throw RuntimeError(context_.device().title() + ": pass light_grid: " + error.what() +
                       " failed: " + cl_error_name(error.err()));
  }
  stats.push_back(pass);
}

void Passes::run(const Batch& batch, std::vector<PassStats>& stats) {
  const DriverGuard guard;
  stats.resize(PASS_COUNT);
  std::array<cl::Event, PASS_COUNT> events;
  const char* pass = "";
  try {
    bind(batch);
    for (int id = 0; id < PASS_COUNT; ++id) {
      pass = PASS_NAMES[id];
      if (runs(static_cast<Id>(id))) events[id] = launch(kernels_[id], id == ACCUMULATE ? batch.pixels : batch.rays());
    }
    context_.queue().finish();
    for (int id = 0; id < PASS_COUNT; ++id) {
      stats[id].name = pass = PASS_NAMES[id];
      if (!runs(static_cast<Id>(id))) continue;
      stats[id].seconds += event_seconds(events[id]);
      stats[id].items += id == ACCUMULATE ? batch.pixels : batch.rays();
    }
  } catch (const cl::Error& error) {
    throw RuntimeError(context_.device().title() + ": pass " + pass + ": " + error.what() +
                       " failed: " + cl_error_name(error.err()));
  }
}

void Passes::read_film(Film& film, const Frame& frame, const Batch& batch) const {
  constexpr std::size_t BYTES = sizeof(FilmPixel);
  const auto row = static_cast<std::size_t>(frame.crop_x1 - frame.crop_x0),
             film_row = static_cast<std::size_t>(film.size().x);
  for (std::size_t first = batch.first_pixel, left = batch.pixels; left > 0;) {
    const std::size_t x = first % row, y = first / row;
    const bool whole = x == 0 && left >= row;  // as many rows as there are, or a part of one
    const std::size_t width = whole ? row : std::min(row - x, left), rows = whole ? left / row : 1;
    context_.queue().enqueueReadBufferRect(
        film_, CL_TRUE, {x * BYTES, y, 0}, {(x + frame.crop_x0) * BYTES, y + frame.crop_y0, 0},
        {width * BYTES, rows, 1}, row * BYTES, 0, film_row * BYTES, 0, film.pixels().data());
    first += width * rows;
    left -= width * rows;
  }
}

}  // namespace brume
