// The kernels of a render and the buffers that they hand to each other, one entry per ray of a batch.
#pragma once
#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "base/stopwatch.hpp"
#include "cl/context.hpp"
#include "flat/render_plan.hpp"
#include "render/device_scene.hpp"
#include "render/renderer.hpp"

namespace brume {

// A stretch of work: `pixels` pixels of the crop from first_pixel on, `samples` samples of each from first_sample on.
struct Batch {
  cl_uint first_pixel, pixels, first_sample, samples;
  cl_uint rays() const { return pixels * samples; }
};

class Passes {
 public:
  // options: of kernel_options(), which `tau_channels` must fit.
  Passes(Context& context, std::shared_ptr<DeviceScene> device_scene, const RenderPlan& plan,
         const std::string& options, int tau_channels, std::size_t batch_rays, std::size_t film_pixels);

  double build_seconds() const { return build_seconds_; }
  double upload_seconds() const { return upload_seconds_; }
  double scene_upload_seconds() const { return device_scene_->upload_seconds(); }

  // Fills the light grids, if there are any, piece by piece while go_on(items done) holds; adds time and items to `stats`.
  void fill_light_grids(std::vector<PassStats>& stats, const std::function<bool(double)>& go_on);
  double light_grid_items() const;
  // Enqueues all passes over one batch and waits; adds times and items to `stats`.
  void run(const Batch& batch, std::vector<PassStats>& stats);
  void read_film(Film& film, const Frame& frame, const Batch& batch) const;  // its pixels into their places

 private:
  struct LightGridWork {
    cl_int medium, light;
    cl_uint first, items;
  };
  enum Id { PRIMARY_RAYS, TRAVERSE_DDA, SHADOW_TRANSMITTANCE, SHADE, SECONDARY_RAYS, ACCUMULATE, PASS_COUNT };
  bool runs(Id id) const {
    return id == SHADOW_TRANSMITTANCE ? has_surfaces_ : (id == SECONDARY_RAYS ? has_specular_ : true);
  }
  void create_kernels(const std::string& options);
  void plan_light_grids(const FlatScene& scene, const RenderPlan& plan);
  void create_buffers(std::size_t batch_rays, std::size_t lights);
  void bind(const Batch& batch);
  cl::Event launch(const cl::Kernel& kernel, std::size_t items);
  cl::Event launch_light_grid(const LightGridWork& work);  // waits
  void fill_light_grid(const LightGridWork& grid, PassStats& pass, bool& stopped,
                       const std::function<bool(double)>& go_on);

  Context& context_;
  Stopwatch watch_;  // laps over construction
  std::shared_ptr<DeviceScene> device_scene_;
  DevicePlan scene_;
  double upload_seconds_ = 0, build_seconds_ = 0;
  bool has_surfaces_, has_specular_;
  std::size_t film_pixels_;
  std::size_t group_;
  std::vector<LightGridWork> light_grids_;
  cl::Kernel light_grid_kernel_;
  std::array<cl::Kernel, PASS_COUNT> kernels_;
  std::array<cl_uint, PASS_COUNT> first_argument_{};
  cl::Buffer rays_, hits_, results_, arrivals_, samples_, film_;
};

}  // namespace brume
