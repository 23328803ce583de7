// The kernels of a render and the buffers that they hand to each other, one entry per ray of a batch.
#pragma once
#include <array>
#include <vector>

#include "base/stopwatch.hpp"
#include "cl/context.hpp"
#include "flat/flat_scene.hpp"
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
  Passes(Context& context, const FlatScene& scene, const std::string& options, int tau_channels, std::size_t batch_rays,
         std::size_t film_pixels);

  double build_seconds() const { return build_seconds_; }
  double upload_seconds() const { return upload_seconds_; }

  // Fills the light grids, if there are any; adds time and items to `stats`.
  void fill_light_grids(std::vector<PassStats>& stats);
  // Enqueues all passes over one batch and waits; adds times and items to `stats`.
  void run(const Batch& batch, std::vector<PassStats>& stats);
  void read_film(Film& film, const Frame& frame) const;  // the rendered crop into its place, depths in flat units

 private:
  struct LightGridWork {
    cl_int medium, light;
    cl_uint items;
  };
  enum Id { PRIMARY_RAYS, TRAVERSE_DDA, SHADOW_TRANSMITTANCE, SHADE, SECONDARY_RAYS, ACCUMULATE, PASS_COUNT };
  bool runs(Id id) const {
    return id == SHADOW_TRANSMITTANCE ? has_surfaces_ : (id == SECONDARY_RAYS ? has_specular_ : true);
  }
  void create_kernels(const std::string& options);
  void plan_light_grids(const FlatScene& scene);
  void create_buffers(std::size_t batch_rays, std::size_t lights);
  void bind(const Batch& batch);
  cl::Event launch(const cl::Kernel& kernel, std::size_t items);
  cl::Event launch_light_grid(const LightGridWork& work);  // waits

  Context& context_;
  Stopwatch watch_;  // laps over construction
  DeviceScene scene_;
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
