// See renderer.hpp.
#include "render/renderer.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/foreign_lines.hpp"
#include "base/stopwatch.hpp"
#include "cl/driver_guard.hpp"
#include "cl/program_parts.hpp"
#include "render/device_scene.hpp"
#include "render/kernel_options.hpp"
#include "render/pace.hpp"
#include "render/passes.hpp"

namespace brume {

namespace {

// Rays in flight at most: on a CPU no more than its caches hold, on a GPU enough to fill it. The first batch shows how
// long they take.
constexpr int BATCH_CPU = 1 << 14, BATCH_GPU = 1 << 19, FIRST_CPU = 1 << 8, FIRST_GPU = 1 << 15;

// What a batch added to a pixel.
void counts_add(RenderCounts& counts, const FilmPixel& before, const FilmPixel& after) {
  counts.lookups += double(after.lookups) - before.lookups;
  counts.shadow_rays += double(after.shadow_rays) - before.shadow_rays;
  counts.secondary_rays += double(after.secondary_rays) - before.secondary_rays;
  counts.dropped_rays += double(after.dropped_rays) - before.dropped_rays;
  counts.dropped_weight += double(after.dropped_weight) - before.dropped_weight;
  counts.invalid_samples += double(after.invalid) - before.invalid;
}

std::shared_ptr<DeviceScene> device_scene_make(Context& context, const FlatScene& scene) {
  const DriverGuard guard;
  const ForeignLines lines("the OpenCL driver");
  return std::make_shared<DeviceScene>(context, scene);
}

}  // namespace

int lanes_choose(const DeviceInfo& device, int wanted) { return wanted > 0 ? wanted : device.lanes(); }
int bvh_width_for(int lanes) { return std::clamp(lanes, 4, 8); }

struct Renderer::State {
  Frame frame;
  std::size_t batch_rays, first_rays;
  std::unique_ptr<Passes> passes;
  RenderStats stats;

  // False where the batch has to be smaller; the film is as before then.
  bool run(const std::vector<Work>& batch, Film& film) {
    const auto fill = [&](FilmPixel* pixels) {
      for (const Work& work : batch) *pixels++ = film.pixels()[work.pixel];
    };
    const auto take = [&](const FilmPixel* pixels) {
      for (const Work& work : batch) pixel_take(film, work.pixel, *pixels++);
    };
    return passes->run(batch, fill, take);
  }

  void pixel_take(Film& film, std::uint32_t place, const FilmPixel& after) {
    FilmPixel& pixel = film.pixels()[place];
    const auto width = static_cast<std::uint32_t>(film.size().x);
    if (after.invalid > pixel.invalid && stats.invalid_samples == 0)
      stats.first_invalid = glm::ivec2(place % width, place / width);
    counts_add(stats, pixel, after);
    pixel = after;
  }
};

Renderer::Renderer(Context& context, const PlannedScene& scene, const RenderOptions& options)
    : Renderer(context, device_scene_make(context, scene), scene, options) {
  state_->stats.upload_s += state_->passes->scene_upload_seconds();
}

namespace {

// A picture of fewer takes less time by generic kernels than it takes to build those of its scene: they are 1.1 to 2.5
// times slower (brume bench --kernels).
constexpr double GENERIC_RAYS = 65536;

bool generic_is_sooner(const Context& context, const FlatScene& scene, const RenderPlan& plan, int lanes) {
  const PartedSource source = passes_source(scene, plan);
  const auto at_hand = [&](bool generic) {
    return parts_at_hand(context, source, kernel_options(scene, plan, context.device(), lanes, generic));
  };
  return !at_hand(false) && at_hand(true);
}

}  // namespace

Renderer::Renderer(Context& context, std::shared_ptr<DeviceScene> device_scene, const RenderPlan& plan,
                   const RenderOptions& options)
    : state_(new State) {
  const DriverGuard guard;
  const ForeignLines lines("the OpenCL driver");
  State& s = *state_;
  const FlatScene& scene = device_scene->flat();
  s.frame = plan.frame;
  const double crop_rays =
      static_cast<double>(s.frame.crop_x1 - s.frame.crop_x0) * (s.frame.crop_y1 - s.frame.crop_y0) * s.frame.camera.spp;
  const int wanted = options.batch_rays > 0 ? options.batch_rays : (context.device().cpu ? BATCH_CPU : BATCH_GPU);
  s.batch_rays = static_cast<std::size_t>(std::clamp(crop_rays, 1.0, static_cast<double>(wanted)));
  s.first_rays = context.device().cpu ? FIRST_CPU : FIRST_GPU;
  s.stats.lanes = lanes_choose(context.device(), options.lanes);

  s.stats.generic = options.generic || (options.sooner && crop_rays <= GENERIC_RAYS &&
                                        generic_is_sooner(context, scene, plan, s.stats.lanes));
  const std::string kernel = kernel_options(scene, plan, context.device(), s.stats.lanes, s.stats.generic);
  const int tau_channels = s.stats.generic || scene.color_tau ? 3 : 1;
  s.passes = std::make_unique<Passes>(context, std::move(device_scene), plan, kernel, tau_channels, s.batch_rays);
  s.stats.kernel_build_s = s.passes->build_seconds();
  s.stats.upload_s = s.passes->upload_seconds();
  s.stats.device_bytes = context.allocated_bytes();
  s.stats.voxel_bytes = scene.voxels.size() * voxel_bytes(plan.storage);
  s.stats.bvh_bytes = (scene.bvh_nodes.size() + scene.bvh_blocks.size()) * sizeof(float);
}

Renderer::~Renderer() = default;

const RenderStats& Renderer::stats() const { return state_->stats; }

const std::shared_ptr<DeviceScene>& Renderer::scene() const { return state_->passes->scene(); }

bool Renderer::render(Film& film, const Progress& progress) { return render(film, work_all(state_->frame), progress); }

bool Renderer::render(Film& film, const WorkList& work, const Progress& progress) {
  State& s = *state_;
  if (film.size() != glm::ivec2(s.frame.camera.width, s.frame.camera.height))
    throw RuntimeError("the film has another size than the camera");
  const DriverGuard guard;
  const Stopwatch watch;
  WorkQueue queue(work, film.pixels().size());
  static_cast<RenderCounts&>(s.stats) = {};
  const double grid_items = s.passes->light_grid_items(), all = grid_items + queue.rays();
  bool go_on = true;
  s.passes->fill_light_grids([&](double items) { return go_on = progress(items / all); });
  Pace pace(s.first_rays, s.batch_rays);
  while (go_on) {
    const std::vector<Work>& batch = queue.next(pace.next());
    if (batch.empty()) break;
    const Stopwatch lap;
    if (!s.run(batch, film)) {
      pace.limit(batch_rays(batch) / 2);
      continue;
    }
    pace.took(batch_rays(batch), lap.seconds());
    queue.done();
    s.stats.primary_rays += batch_rays(batch);
    go_on = progress((grid_items + s.stats.primary_rays) / all);
  }
  s.stats.passes = s.passes->stats();
  s.stats.render_s += watch.seconds();
  return s.stats.primary_rays == queue.rays();
}

}  // namespace brume
