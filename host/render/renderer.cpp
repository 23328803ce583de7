// See renderer.hpp.
#include "render/renderer.hpp"

#include <algorithm>

#include "base/foreign_lines.hpp"
#include "base/stopwatch.hpp"
#include "cl/driver_guard.hpp"
#include "render/device_scene.hpp"
#include "render/kernel_options.hpp"
#include "render/pace.hpp"
#include "render/passes.hpp"

namespace brume {

namespace {

// Rays in flight at most: on a CPU no more than its caches hold, on a GPU enough to fill it. The first batch shows how long they take.
constexpr int BATCH_CPU = 1 << 14, BATCH_GPU = 1 << 19, FIRST_CPU = 1 << 8, FIRST_GPU = 1 << 15;

// Adds up what the rendered crop of the film counted; depths into world units.
void film_finish(Film& film, const Frame& frame, double unit, RenderStats& stats) {
  for (auto y = static_cast<std::size_t>(frame.crop_y0); y < static_cast<std::size_t>(frame.crop_y1); ++y)
    for (auto x = static_cast<std::size_t>(frame.crop_x0); x < static_cast<std::size_t>(frame.crop_x1); ++x) {
      FilmPixel& p = film.pixels()[y * static_cast<std::size_t>(film.size().x) + x];
      stats.lookups += p.lookups;
      stats.shadow_rays += p.shadow_rays;
      stats.secondary_rays += p.secondary_rays;
      stats.dropped_rays += p.dropped_rays;
      stats.dropped_weight += p.dropped_weight;
      p.depth = static_cast<float>(p.depth * unit);
      if (p.invalid > 0 && stats.invalid_samples == 0) stats.first_invalid = {static_cast<int>(x), static_cast<int>(y)};
      stats.invalid_samples += p.invalid;
    }
}

std::shared_ptr<DeviceScene> device_scene_make(Context& context, const FlatScene& scene) {
  const DriverGuard guard;
  const ForeignLines lines("the OpenCL driver");
  return std::make_shared<DeviceScene>(context, scene);
}

std::size_t voxel_bytes(int storage) { return storage == STORAGE_F32 ? 4 : (storage == STORAGE_F16 ? 2 : 1); }

}  // namespace

int lanes_choose(const DeviceInfo& device, int wanted) { return wanted > 0 ? wanted : device.lanes(); }
int bvh_width_for(int lanes) { return std::max(lanes, 4); }

struct Renderer::State {
  Frame frame;
  double unit;
  std::size_t crop_pixels, batch_rays, first_rays;
  std::unique_ptr<Passes> passes;
  RenderStats stats;

  double total_rays() const { return static_cast<double>(crop_pixels) * frame.camera.spp; }

  // What comes next, at most `rays` rays: whole pixels, or some samples of one.
  Batch batch_at(std::size_t pixel, std::size_t sample, std::size_t rays) const {
    const auto spp = static_cast<std::size_t>(frame.camera.spp);
    const bool whole = sample == 0 && rays >= spp;
    return {static_cast<cl_uint>(pixel), static_cast<cl_uint>(whole ? std::min(rays / spp, crop_pixels - pixel) : 1),
            static_cast<cl_uint>(sample), static_cast<cl_uint>(whole ? spp : std::min(rays, spp - sample))};
  }
};

Renderer::Renderer(Context& context, const PlannedScene& scene, const RenderOptions& options)
    : Renderer(context, device_scene_make(context, scene), scene, options) {
  state_->stats.upload_s += state_->passes->scene_upload_seconds();
}

Renderer::Renderer(Context& context, std::shared_ptr<DeviceScene> device_scene, const RenderPlan& plan,
                   const RenderOptions& options)
    : state_(new State) {
  const DriverGuard guard;
  const ForeignLines lines("the OpenCL driver");
  State& s = *state_;
  const FlatScene& scene = device_scene->flat();
  s.frame = plan.frame;
  s.unit = scene.unit;
  s.crop_pixels = static_cast<std::size_t>(s.frame.crop_x1 - s.frame.crop_x0) * (s.frame.crop_y1 - s.frame.crop_y0);
  const std::size_t wanted =
      options.batch_rays > 0 ? options.batch_rays : (context.device().cpu ? BATCH_CPU : BATCH_GPU);
  s.batch_rays = std::min(wanted, static_cast<std::size_t>(s.total_rays()));
  s.first_rays = context.device().cpu ? FIRST_CPU : FIRST_GPU;
  s.stats.lanes = lanes_choose(context.device(), options.lanes);

  const std::string kernel = kernel_options(scene, plan, context.device(), s.stats.lanes, options.generic);
  const int tau_channels = options.generic || scene.color_tau ? 3 : 1;
  s.passes = std::make_unique<Passes>(context, std::move(device_scene), plan, kernel, tau_channels, s.batch_rays,
                                      s.crop_pixels);
  s.stats.kernel_build_s = s.passes->build_seconds();
  s.stats.upload_s = s.passes->upload_seconds();
  s.stats.device_bytes = context.allocated_bytes();
  s.stats.voxel_bytes = scene.voxels.size() * voxel_bytes(plan.storage);
  s.stats.bvh_bytes = (scene.bvh_nodes.size() + scene.bvh_blocks.size()) * sizeof(float) +
                      (scene.bvh_links.size() + scene.bvh_ids.size()) * sizeof(std::int32_t);
}

Renderer::~Renderer() = default;

const RenderStats& Renderer::stats() const { return state_->stats; }

bool Renderer::render(Film& film, const Progress& progress) {
  State& s = *state_;
  const DriverGuard guard;
  const Stopwatch watch;
  s.stats.primary_rays = 0;
  const double grid_items = s.passes->light_grid_items(), all = grid_items + s.total_rays();
  bool go_on = true;
  s.passes->fill_light_grids([&](double items) { return go_on = progress(items / all); });
  Pace pace(s.first_rays, s.batch_rays);
  std::size_t pixel = 0, sample = 0;
  while (go_on && pixel < s.crop_pixels) {
    const Batch batch = s.batch_at(pixel, sample, pace.next());
    const Stopwatch lap;
    if (!s.passes->run(batch)) {
      pace.limit(batch.rays() / 2);
      continue;
    }
    pace.took(batch.rays(), lap.seconds());
    s.passes->read_film(film, s.frame, batch);
    s.stats.primary_rays += batch.rays();
    sample += batch.samples;
    if (sample == static_cast<std::size_t>(s.frame.camera.spp)) {
      sample = 0;
      pixel += batch.pixels;
    }
    go_on = progress((grid_items + s.stats.primary_rays) / all);
  }
  s.stats.passes = s.passes->stats();
  s.stats.render_s += watch.seconds();
  finish(film);
  return s.stats.primary_rays == s.total_rays();
}

void Renderer::finish(Film& film) { film_finish(film, state_->frame, state_->unit, state_->stats); }

}  // namespace brume
