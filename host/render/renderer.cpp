// See renderer.hpp.
#include "render/renderer.hpp"

#include <algorithm>

#include "base/stopwatch.hpp"
#include "render/kernel_options.hpp"
#include "render/passes.hpp"

namespace brume {

namespace {

// Small enough on a CPU that Ctrl-C answers soon, large enough on a GPU to fill it.
constexpr int BATCH_CPU = 1 << 14, BATCH_GPU = 1 << 19;

// Adds up what the rendered crop of the film counted; depths into world units.
void film_finish(Film& film, const Frame& frame, double unit, RenderStats& stats) {
  for (auto y = static_cast<std::size_t>(frame.crop_y0); y < static_cast<std::size_t>(frame.crop_y1); ++y)
    for (auto x = static_cast<std::size_t>(frame.crop_x0); x < static_cast<std::size_t>(frame.crop_x1); ++x) {
      FilmPixel& p = film.pixels()[y * static_cast<std::size_t>(film.size().x) + x];
      stats.lookups += p.lookups;
      stats.shadow_rays += p.shadow_rays;
      stats.secondary_rays += p.secondary_rays;
      p.depth = static_cast<float>(p.depth * unit);
      if (p.invalid > 0 && stats.invalid_samples == 0) stats.first_invalid = {static_cast<int>(x), static_cast<int>(y)};
      stats.invalid_samples += p.invalid;
    }
}

}  // namespace

int lanes_choose(const DeviceInfo& device, int wanted) { return wanted > 0 ? wanted : device.lanes(); }
int bvh_width_for(int lanes) { return std::max(lanes, 4); }

struct Renderer::State {
  Frame frame;
  double unit;
  std::size_t crop_pixels, batch_rays;
  std::unique_ptr<Passes> passes;
  RenderStats stats;

  double total_rays() const { return static_cast<double>(crop_pixels) * frame.camera.spp; }
};

Renderer::Renderer(Context& context, const FlatScene& scene, const RenderOptions& options) : state_(new State) {
  State& s = *state_;
  s.frame = scene.frame;
  s.unit = scene.unit;
  s.crop_pixels = static_cast<std::size_t>(s.frame.crop_x1 - s.frame.crop_x0) * (s.frame.crop_y1 - s.frame.crop_y0);
  const std::size_t wanted =
      options.batch_rays > 0 ? options.batch_rays : (context.device().cpu ? BATCH_CPU : BATCH_GPU);
  s.batch_rays = std::min(wanted, static_cast<std::size_t>(s.total_rays()));
  s.stats.lanes = lanes_choose(context.device(), options.lanes);

  const std::string kernel = kernel_options(scene, context.device(), s.stats.lanes, options.generic);
  const int tau_channels = options.generic || scene.color_tau ? 3 : 1;
  s.passes = std::make_unique<Passes>(context, scene, kernel, tau_channels, s.batch_rays, s.crop_pixels);
  s.stats.kernel_build_s = s.passes->build_seconds();
  s.stats.upload_s = s.passes->upload_seconds();
  s.stats.device_bytes = context.allocated_bytes();
  s.stats.voxel_bytes = scene.packed.empty() ? scene.voxels.size() * sizeof(float) : scene.packed.size();
  s.stats.bvh_bytes = (scene.bvh_nodes.size() + scene.bvh_blocks.size()) * sizeof(float) +
                      (scene.bvh_links.size() + scene.bvh_ids.size()) * sizeof(std::int32_t);
}

Renderer::~Renderer() = default;

const RenderStats& Renderer::stats() const { return state_->stats; }

bool Renderer::render(Film& film, const Progress& progress) {
  State& s = *state_;
  const Stopwatch watch;
  const auto spp = static_cast<std::size_t>(s.frame.camera.spp);
  const std::size_t samples = std::min(spp, s.batch_rays);
  const std::size_t pixels = s.batch_rays / samples;
  double done = 0;
  bool go_on = true;
  std::vector<PassStats> light_grids;
  s.passes->fill_light_grids(light_grids);
  for (std::size_t pixel = 0; pixel < s.crop_pixels && go_on; pixel += pixels) {
    for (std::size_t sample = 0; sample < spp && go_on; sample += samples) {
      const Batch batch{static_cast<cl_uint>(pixel), static_cast<cl_uint>(std::min(pixels, s.crop_pixels - pixel)),
                        static_cast<cl_uint>(sample), static_cast<cl_uint>(std::min(samples, spp - sample))};
      s.passes->run(batch, s.stats.passes);
      done += batch.rays();
      go_on = progress(done / s.total_rays());
    }
  }
  s.stats.passes.insert(s.stats.passes.begin(), light_grids.begin(), light_grids.end());
  s.passes->read_film(film, s.frame);
  s.stats.render_s += watch.seconds();
  s.stats.primary_rays = done;
  film_finish(film, s.frame, s.unit, s.stats);
  return done == s.total_rays();
}

}  // namespace brume
