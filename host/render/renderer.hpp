// FlatScene → Film on an OpenCL device: builds the kernels, uploads the scene, runs the passes batch by batch.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cl/context.hpp"
#include "film/film.hpp"
#include "plan/render_plan.hpp"
#include "render/work.hpp"

namespace brume {

class DeviceScene;  // render/device_scene.hpp

struct RenderOptions {
  int lanes = 0;         // 0: the device's own choice
  bool generic = false;  // kernels with every feature, not only those of the scene
  int batch_rays = 0;    // rays in flight; 0: by device
  bool sooner = false;   // generic ones for a small picture too, where those of the scene would have to be built
};

struct PassStats {
  std::string name;
  double seconds = 0;
  double items = 0;
};

// Of one render().
struct RenderCounts {
  double primary_rays = 0, secondary_rays = 0, shadow_rays = 0, lookups = 0;
  double dropped_rays = 0, dropped_weight = 0;  // FilmPixel::dropped_rays, dropped_weight
  double invalid_samples = 0;                   // left out of their pixels (FilmPixel::invalid)
  glm::ivec2 first_invalid{-1, -1};             // pixel of the first of them in the work list, from the top left
};

// Seconds and passes: of all that the renderer did.
struct RenderStats : RenderCounts {
  int lanes = 0;
  bool generic = false;  // its kernels
  double kernel_build_s = 0, upload_s = 0, render_s = 0;
  std::vector<PassStats> passes;
  std::size_t device_bytes = 0, voxel_bytes = 0, bvh_bytes = 0;
};

// Share of the work done, in [0,1], told at least every fifth of a second or so. Returning false stops the render after
// the current batch.
using Progress = std::function<bool(double)>;

class Renderer {
 public:
  // Builds and uploads. `scene.bvh_width` must suit the lanes (bvh_width_for).
  // The scene must outlive this, unchanged.
  Renderer(Context& context, const PlannedScene& scene, const RenderOptions& options);
  Renderer(Context&, PlannedScene&&, const RenderOptions&) = delete;
  // The same for one of several plans of a scene that was uploaded: only what the plan itself holds is uploaded.
  Renderer(Context& context, std::shared_ptr<DeviceScene> scene, const RenderPlan& plan, const RenderOptions& options);
  ~Renderer();

  // Adds the samples of `work` to what the film holds, to each pixel in the order of its entries. The film, which has
  // the size of the camera, is ready to be written after every batch: stopped early it holds what was done
  // (stats().primary_rays says how much, also while it goes on); returns false then. RuntimeError: a film of another
  // size, work outside of it.
  bool render(Film& film, const WorkList& work, const Progress& progress);
  bool render(Film& film, const Progress& progress);  // work_all
  const RenderStats& stats() const;
  const std::shared_ptr<DeviceScene>& scene() const;  // as uploaded, for other plans of it

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// The lanes that a device uses when none are asked for, and the BVH width that goes with lanes.
int lanes_choose(const DeviceInfo& device, int wanted);
int bvh_width_for(int lanes);

}  // namespace brume
