// See passes.hpp. The order of arguments follows kernels/passes/*.cl.
#include "render/passes.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <string_view>
#include <utility>

#include "base/error.hpp"
#include "cl/driver_guard.hpp"
#include "cl/program.hpp"
#include "render/kernel_options.hpp"
#include "render/pace.hpp"
#include "shared/ray.h"

namespace brume {

namespace {

bool always(const FlatScene&, const RenderPlan&) { return true; }
bool has_liquids(const FlatScene& scene, const RenderPlan&) { return !scene.gradient_bricks.empty(); }
bool has_light_grids(const FlatScene&, const RenderPlan& plan) { return !plan.light_grids.empty(); }
bool has_surfaces(const FlatScene& scene, const RenderPlan&) {
  return !scene.shapes.empty() || !scene.triangles.empty();
}
bool has_specular(const FlatScene& scene, const RenderPlan& plan) {
  return has_surfaces(scene, plan) && plan.frame.max_depth > 0 && scene_is_specular(scene);
}

struct PassRow {
  const char* name;
  bool (*runs)(const FlatScene&, const RenderPlan&);
  int compiles_ms;   // beside what any program takes, measured on some scenes; traverse_dda: TRAVERSE_MS
  int triangles_ms;  // more where there are triangles
  bool takes_scene;  // reads all of it, or nothing
};
// In the order of Passes::Id.
constexpr PassRow PASSES[] = {{"presence_gradients", has_liquids, 70, 0, true},
                              {"light_grid", has_light_grids, 155, 0, true},
                              {"primary_rays", always, 160, 100, true},
                              {"traverse_dda", always, 0, 0, true},
                              {"shadow_transmittance", has_surfaces, 180, 250, true},
                              {"shade", always, 60, 0, true},
                              {"secondary_rays", has_specular, 45, 0, false},
                              {"accumulate", always, 40, 0, false}};

// Rays that a wave has room for, at least: what one sample may send on.
constexpr std::size_t WAVE_LEAST = 2 * SECONDARY_RAYS_MAX;

constexpr std::size_t PIECE_FIRST = 512;  // of a light grid

double event_seconds(const cl::Event& event) {
  return 1e-9 * static_cast<double>(event.getProfilingInfo<CL_PROFILING_COMMAND_END>() -
                                    event.getProfilingInfo<CL_PROFILING_COMMAND_START>());
}

constexpr int TRAVERSE_MS[] = {60, 260, 450, 600};  // without media, with one, with several, among triangles
constexpr int OTHER_BEGINS_MS = 30;                 // what the program that builds the second part takes to begin

int traverse_ms(const FlatScene& scene) {
  const bool among_triangles = !scene.media.empty() && !scene.triangles.empty();
  return TRAVERSE_MS[among_triangles ? 3 : std::min<std::size_t>(scene.media.size(), 2)];
}

int compile_ms(const PassRow& pass, const FlatScene& scene) {
  if (pass.name == std::string_view("traverse_dda")) return traverse_ms(scene);
  return pass.compiles_ms + (scene.triangles.empty() ? 0 : pass.triangles_ms);
}

using Parts = std::array<std::size_t, std::size(PASSES)>;

// Which part each pass is in: the longest first, each goes to the part that is done sooner so far.
Parts passes_parts(const FlatScene& scene, const RenderPlan& plan) {
  std::array<std::size_t, std::size(PASSES)> order{};
  std::iota(order.begin(), order.end(), std::size_t(0));
  const auto takes = [&](std::size_t id) { return compile_ms(PASSES[id], scene); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return takes(a) > takes(b); });
  Parts parts{};
  std::array<int, 2> all_ms{0, OTHER_BEGINS_MS};
  for (const std::size_t id : order) {
    if (!PASSES[id].runs(scene, plan)) continue;
    parts[id] = all_ms[1] < all_ms[0];
    all_ms[parts[id]] += takes(id);
  }
  return parts;
}

}  // namespace

PartedSource passes_source(const FlatScene& scene, const RenderPlan& plan) {
  const Parts parts = passes_parts(scene, plan);
  PartedSource source;
  std::string all;
  for (std::size_t id = 0; id < std::size(PASSES); ++id) {
    if (!PASSES[id].runs(scene, plan)) continue;
    const std::string include = std::string("#include \"passes/") + PASSES[id].name + ".cl\"\n";
    source.parts[parts[id]] += include;
    all += include;
  }
  source.whole = kernel_source_text(all, "passes");
  return source;
}

Passes::Passes(Context& context, std::shared_ptr<DeviceScene> device_scene, const RenderPlan& plan,
               const std::string& options, int tau_channels, std::size_t batch_rays)
    : context_(context),
      device_scene_(std::move(device_scene)),
      scene_(context, *device_scene_, plan, tau_channels),
      storage_(plan.storage),
      has_surfaces_(has_surfaces(device_scene_->flat(), plan)),
      has_specular_(has_specular(device_scene_->flat(), plan)),
      unit_(static_cast<cl_float>(device_scene_->flat().unit)) {
  static_assert(std::size(PASSES) == PASS_COUNT, "one row per pass");
  for (const PassRow& pass : PASSES) stats_.push_back({pass.name, 0, 0});
  create_buffers(batch_rays);
  plan_light_grids(device_scene_->flat(), plan);
  upload_seconds_ = watch_.lap();
  create_kernels(plan, options);
  build_seconds_ = watch_.lap();
}

void Passes::plan_light_grids(const FlatScene& scene, const RenderPlan& plan) {
  int filled = 0;  // entries; media that share a grid follow the one that fills it
  for (std::size_t m = 0; m < scene.media.size(); ++m)
    for (std::size_t l = 0; plan.walks[m].light_grids >= 0 && l < plan.lights.size(); ++l) {
      const LightGrid& grid = plan.light_grids[static_cast<std::size_t>(plan.walks[m].light_grids) + l];
      if (grid.offset < filled) continue;
      filled = grid.offset + grid.nu * grid.nv * grid.nk;
      const int items = grid.columns_u * grid.columns_v * (grid.column_step > 0 ? 1 : grid.nk);
      light_grids_.push_back({static_cast<cl_int>(m), static_cast<cl_int>(l), 0, static_cast<cl_uint>(items)});
    }
}

void Passes::create_buffers(std::size_t batch_rays) {
  wave_rays_ = has_specular_ ? std::max(SENT_MAX * batch_rays, WAVE_LEAST) : batch_rays;
  const std::size_t sent = has_specular_ ? wave_rays_ : 0;
  work_ = context_.buffer("work", batch_rays * sizeof(Work));
  rays_ = context_.buffer("rays", wave_rays_ * sizeof(Ray));
  hits_ = context_.buffer("hits", wave_rays_ * sizeof(Hit));
  results_ = context_.buffer("media results", wave_rays_ * sizeof(MediumResult));
  surfaces_ = context_.buffer("surface results", has_surfaces_ ? wave_rays_ * sizeof(SurfaceResult) : 0);
  sent_ = context_.buffer("rays sent on", SENT_MAX * sent * sizeof(Ray));
  samples_ = context_.buffer("samples", batch_rays * sizeof(Sample));
  sample_sent_ = context_.buffer("numbers of rays sent on", batch_rays * sizeof(cl_uint));
  sample_first_ = context_.buffer("first rays sent on", has_specular_ ? batch_rays * sizeof(cl_uint) : 0);
  pixels_ = context_.buffer("pixels", batch_rays * sizeof(FilmPixel));
}

// PoCL compiles a kernel at its first launch: an empty one moves that out of the render time.
void Passes::create_kernels(const RenderPlan& plan, const std::string& options) {
  const FlatScene& scene = device_scene_->flat();
  const DriverGuard guard;
  const std::vector<cl::Program> programs = parts_build(context_, passes_source(scene, plan), options);
  const Parts parts = passes_parts(scene, plan);
  for (int id = 0; id < PASS_COUNT; ++id) {
    if (!PASSES[id].runs(scene, plan)) continue;
    kernels_[id] = kernel_create(programs[std::min(parts[id], programs.size() - 1)], PASSES[id].name);
    if (PASSES[id].takes_scene) first_argument_[id] = scene_.set_arguments(kernels_[id]);
  }
  try {
    if (PASSES[GRADIENTS].runs(scene, plan)) enqueue(GRADIENTS, 0, cl_uint(0), scene_.gradients());
    if (!light_grids_.empty()) enqueue(LIGHT_GRID, 0, cl_int(0), cl_int(0), cl_uint(0), cl_uint(0), scene_.light_tau());
    enqueue_wave(0, 0, 0, 0);
    if (has_specular_) next_wave(0);
    enqueue(ACCUMULATE, 0, work_, cl_uint(0), unit_, samples_, pixels_);
    context_.queue().finish();
  } catch (const cl::Error& error) {
    failed(error);
  }
  enqueued_.clear();
  for (const cl::Program& program : programs) program_used(context_, program);
}

void Passes::failed(const cl::Error& error) const {
  throw RuntimeError(context_.device().title() + ": pass " + PASSES[running_].name + ": " + error.what() +
                     " failed: " + cl_error_name(error.err()));
}

template <class... Values>
void Passes::enqueue(Id id, std::size_t items, const Values&... values) {
  running_ = id;
  cl_uint argument = first_argument_[id];
  (kernels_[id].setArg(argument++, values), ...);
  enqueued_.push_back({id, items, context_.launch(kernels_[id], items)});
}

void Passes::finish() {
  context_.queue().finish();
  for (const Enqueued& pass : enqueued_) {
    running_ = pass.id;
    stats_[pass.id].seconds += event_seconds(pass.event);
    stats_[pass.id].items += static_cast<double>(pass.items);
  }
  enqueued_.clear();
}

double Passes::light_grid_items() const {
  double items = 0;
  for (const LightGridWork& grid : light_grids_) items += grid.items - grid.first;
  return items;
}

void Passes::fill_light_grid(LightGridWork& grid, double& done, bool& stopped,
                             const std::function<bool(double)>& go_on) {
  Pace pace(PIECE_FIRST, grid.items);
  while (grid.first < grid.items && !stopped) {
    const cl_uint items = std::min(static_cast<cl_uint>(pace.next()), grid.items - grid.first);
    const Stopwatch lap;
    enqueue(LIGHT_GRID, items, grid.medium, grid.light, grid.first, grid.first + items, scene_.light_tau());
    finish();
    pace.took(items, lap.seconds());
    grid.first += items;
    stopped = !go_on(done += items);
  }
}

void Passes::fill_gradients() {
  if (!device_scene_->gradients_wanted(storage_)) return;
  const std::size_t items = device_scene_->flat().gradient_bricks.size() * GRADIENT_ITEMS;
  enqueue(GRADIENTS, items, static_cast<cl_uint>(items), scene_.gradients());
  finish();
  device_scene_->gradients_done(storage_);
}

void Passes::fill_light_grids(const std::function<bool(double)>& go_on) {
  bool stopped = false;
  double done = 0;
  try {
    fill_gradients();
    for (LightGridWork& grid : light_grids_) fill_light_grid(grid, done, stopped, go_on);
  } catch (const cl::Error& error) {
    failed(error);
  }
}

void Passes::enqueue_wave(cl_uint entries, cl_uint samples, cl_uint wave, cl_uint rays) {
  enqueue(PRIMARY_RAYS, rays, work_, entries, wave, rays, rays_, hits_);
  enqueue(TRAVERSE_DDA, rays, rays, rays_, hits_, results_);
  if (has_surfaces_) enqueue(SHADOW_TRANSMITTANCE, rays, wave, rays, rays_, hits_, results_, surfaces_, sent_);
  enqueue(SHADE, samples, wave, samples, rays_, hits_, results_, surfaces_, samples_, sample_sent_);
}

// Rays of one sample stay side by side and in order, so that what a sample adds up does not depend on the batch.
cl_uint Passes::next_wave(cl_uint samples) {
  sent_counts_.resize(samples);
  std::size_t rays = 0;
  if (samples > 0)
    context_.queue().enqueueReadBuffer(sample_sent_, CL_TRUE, 0, samples * sizeof(cl_uint), sent_counts_.data());
  for (cl_uint& count : sent_counts_) rays += std::exchange(count, static_cast<cl_uint>(rays));
  if (rays > wave_rays_) return static_cast<cl_uint>(wave_rays_ + 1);
  if (samples > 0 && rays == 0) return 0;
  if (samples > 0)
    context_.queue().enqueueWriteBuffer(sample_first_, CL_FALSE, 0, samples * sizeof(cl_uint), sent_counts_.data());
  enqueue(SECONDARY_RAYS, samples, samples, hits_, surfaces_, sent_, sample_sent_, sample_first_, samples_, rays_);
  return static_cast<cl_uint>(rays);
}

bool Passes::enqueue_waves(cl_uint entries, cl_uint samples) {
  cl_uint rays = samples;
  for (cl_uint wave = 0; rays > 0; ++wave) {
    enqueue_wave(entries, samples, wave, rays);
    rays = has_specular_ ? next_wave(samples) : 0;
    if (rays > wave_rays_) return false;
  }
  return true;
}

// A map that fails throws before `use` is called; one that `use` leaves by an exception dies with the queue.
template <class Use>
void Passes::with_pixels(std::size_t count, cl_map_flags flags, const Use& use) {
  void* mapped = context_.queue().enqueueMapBuffer(pixels_, CL_TRUE, flags, 0, count * sizeof(FilmPixel));
  use(static_cast<FilmPixel*>(mapped));
  context_.queue().enqueueUnmapMemObject(pixels_, mapped);
}

bool Passes::run(const std::vector<Work>& batch, const Fill& fill, const Take& take) {
  const DriverGuard guard;
  const auto entries = static_cast<cl_uint>(batch.size());
  try {
    context_.queue().enqueueWriteBuffer(work_, CL_FALSE, 0, batch.size() * sizeof(Work), batch.data());
    with_pixels(entries, CL_MAP_WRITE_INVALIDATE_REGION, fill);
    const bool fits = enqueue_waves(entries, batch_rays(batch));
    if (fits) enqueue(ACCUMULATE, entries, work_, entries, unit_, samples_, pixels_);
    finish();
    if (fits) with_pixels(entries, CL_MAP_READ, take);
    return fits;
  } catch (const cl::Error& error) {
    failed(error);
  }
}

}  // namespace brume
