// The kernels of a render and the buffers that they hand to each other, one entry per ray or pixel of a batch.
#pragma once
#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "base/stopwatch.hpp"
#include "cl/context.hpp"
#include "cl/program_parts.hpp"
#include "plan/render_plan.hpp"
#include "render/device_scene.hpp"
#include "render/renderer.hpp"
#include "render/work.hpp"

namespace brume {

// The kernels of one picture of a scene as one text, whose front end reads what they share once; and in two parts that
// take about as long to compile.
PartedSource passes_source(const FlatScene& scene, const RenderPlan& plan);

class Passes {
 public:
  // options: of kernel_options(), which `tau_channels` must fit. A batch has at most batch_rays rays.
  Passes(Context& context, std::shared_ptr<DeviceScene> device_scene, const RenderPlan& plan,
         const std::string& options, int tau_channels, std::size_t batch_rays);

  const std::shared_ptr<DeviceScene>& scene() const { return device_scene_; }
  double build_seconds() const { return build_seconds_; }
  double upload_seconds() const { return upload_seconds_; }
  double scene_upload_seconds() const { return device_scene_->upload_seconds(); }

  // Computes the gradients of liquids, if nobody has, and fills the light grids, if there are any, piece by piece while
  // go_on(items done) holds: what an earlier call has left.
  void fill_light_grids(const std::function<bool(double)>& go_on);
  double light_grid_items() const;  // that are left
  // All passes over one batch: a wave of camera rays, then one of the rays that they send on, until none is left.
  // `fill` writes what the pixel of each entry holds, `take` reads what it holds with its samples added; both in the
  // device's own memory where that is the host's. False where a wave would hold more rays than there is room for;
  // nothing is taken then. A batch of one sample always fits.
  using Fill = std::function<void(FilmPixel* pixels)>;
  using Take = std::function<void(const FilmPixel* pixels)>;
  bool run(const std::vector<Work>& batch, const Fill& fill, const Take& take);

  const std::vector<PassStats>& stats() const { return stats_; }  // of all that was run, in the order of the passes

 private:
  struct LightGridWork {
    cl_int medium, light;
    cl_uint first, items;  // those before `first` are filled
  };
  // In the order in which they run; shared by the table of names and items in passes.cpp.
  enum Id {
    GRADIENTS,
    LIGHT_GRID,
    PRIMARY_RAYS,
    TRAVERSE_DDA,
    SHADOW_TRANSMITTANCE,
    SHADE,
    SECONDARY_RAYS,
    ACCUMULATE,
    PASS_COUNT
  };
  void create_kernels(const RenderPlan& plan, const std::string& options);
  void plan_light_grids(const FlatScene& scene, const RenderPlan& plan);
  void create_buffers(std::size_t batch_rays);
  template <class... Values>
  void enqueue(Id id, std::size_t items, const Values&... values);
  void enqueue_wave(cl_uint entries, cl_uint samples, cl_uint wave, cl_uint rays);
  bool enqueue_waves(cl_uint entries, cl_uint samples);
  cl_uint next_wave(cl_uint samples);  // rays of the next wave; 0: none, above wave_rays_: more than there is room for
  void finish();                       // waits for what is enqueued and adds its times to the statistics
  void fill_gradients();
  void fill_light_grid(LightGridWork& grid, double& done, bool& stopped, const std::function<bool(double)>& go_on);
  template <class Use>
  void with_pixels(std::size_t count, cl_map_flags flags, const Use& use);
  [[noreturn]] void failed(const cl::Error& error) const;

  struct Enqueued {
    Id id;
    std::size_t items;
    cl::Event event;
  };

  Context& context_;
  Stopwatch watch_;  // laps over construction
  std::shared_ptr<DeviceScene> device_scene_;
  DevicePlan scene_;
  int storage_;
  double upload_seconds_ = 0, build_seconds_ = 0;
  bool has_surfaces_, has_specular_;
  cl_float unit_;  // FlatScene::unit
  std::size_t wave_rays_ = 0;
  std::vector<LightGridWork> light_grids_;
  std::array<cl::Kernel, PASS_COUNT> kernels_;
  std::array<cl_uint, PASS_COUNT> first_argument_{};
  std::vector<Enqueued> enqueued_;
  std::vector<PassStats> stats_;
  Id running_ = PRIMARY_RAYS;  // for messages
  std::vector<cl_uint> sent_counts_;
  cl::Buffer work_, rays_, hits_, results_, surfaces_, sent_, samples_, sample_sent_, sample_first_, pixels_;
};

}  // namespace brume
