// See passes.hpp. The order of arguments follows kernels/passes/*.cl.
#include "render/passes.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "cl/program.hpp"
#include "shared/ray.h"

namespace brume {

namespace {

constexpr const char* PASS_NAMES[] = {"primary_rays", "traverse_dda", "shadow_transmittance", "shade", "accumulate"};

// One program for all passes: the front end reads the shared text once.
std::string passes_source() {
  std::string text;
  for (const char* name : PASS_NAMES) text += std::string("#include \"passes/") + name + ".cl\"\n";
  return kernel_source_text(text, "passes");
}

// Private arrays of all items of a group lie on the worker's stack in PoCL: few items on a CPU.
constexpr std::size_t GROUP_CPU = 16, GROUP_GPU = 64;

}  // namespace

Passes::Passes(Context& context, const FlatScene& scene, const std::string& options, std::size_t batch_rays,
               std::size_t film_pixels)
    : context_(context),
      scene_(context, scene),
      has_surfaces_(!scene.shapes.empty() || !scene.triangles.empty()),
      film_pixels_(film_pixels),
      group_(std::min(context.device().cpu ? GROUP_CPU : GROUP_GPU, context.device().max_group)) {
  create_buffers(batch_rays, scene.lights.size());
  upload_seconds_ = watch_.lap();
  create_kernels(options);
  // PoCL compiles a kernel at its first launch: an empty batch moves that out of the render time.
  std::vector<PassStats> unused;
  run({0, 0, 0, 1}, unused);
  build_seconds_ = watch_.lap();
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
    kernels_[id] = cl::Kernel(program, PASS_NAMES[id]);
    first_argument_[id] = id == ACCUMULATE ? 0 : scene_.set_arguments(kernels_[id]);
  }
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
  set(ACCUMULATE, batch.first_pixel, batch.pixels, batch.samples, hits_, results_, samples_, film_);
}

cl::Event Passes::launch(Id id, std::size_t items) {
  cl::Event event;
  const std::size_t groups = std::max<std::size_t>((items + group_ - 1) / group_, 1);
  context_.queue().enqueueNDRangeKernel(kernels_[id], cl::NullRange, cl::NDRange(groups * group_), cl::NDRange(group_),
                                        nullptr, &event);
  return event;
}

void Passes::run(const Batch& batch, std::vector<PassStats>& stats) {
  stats.resize(PASS_COUNT);
  std::array<cl::Event, PASS_COUNT> events;
  const char* pass = "";
  try {
    bind(batch);
    for (int id = 0; id < PASS_COUNT; ++id) {
      pass = PASS_NAMES[id];
      if (runs(static_cast<Id>(id)))
        events[id] = launch(static_cast<Id>(id), id == ACCUMULATE ? batch.pixels : batch.rays());
    }
    context_.queue().finish();
    for (int id = 0; id < PASS_COUNT; ++id) {
      stats[id].name = pass = PASS_NAMES[id];
      if (!runs(static_cast<Id>(id))) continue;
      stats[id].seconds += 1e-9 * static_cast<double>(events[id].getProfilingInfo<CL_PROFILING_COMMAND_END>() -
                                                      events[id].getProfilingInfo<CL_PROFILING_COMMAND_START>());
      stats[id].items += id == ACCUMULATE ? batch.pixels : batch.rays();
    }
  } catch (const cl::Error& error) {
    throw RuntimeError(context_.device().title() + ": pass " + pass + ": " + error.what() +
                       " failed: " + cl_error_name(error.err()));
  }
}

void Passes::read_film(std::vector<FilmPixel>& pixels) const {
  pixels.resize(film_pixels_);
  context_.queue().enqueueReadBuffer(film_, CL_TRUE, 0, film_pixels_ * sizeof(FilmPixel), pixels.data());
}

}  // namespace brume
