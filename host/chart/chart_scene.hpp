// One loaded scene, rendered by any setting: its flat arrays are made and uploaded once for each level of detail and
// each way in which constant densities are taken, as such or as voxels.
#pragma once
#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "chart/point.hpp"
#include "cl/context.hpp"
#include "image/image.hpp"
#include "load/loaded_scene.hpp"
#include "plan/render_plan.hpp"
#include "render/device_scene.hpp"
#include "render/renderer.hpp"

namespace brume {

struct ChartOptions {
  int lanes = 0;  // chosen already
  bool generic = false;
  std::array<int, 4> crop{0, 0, 0, 0};
};

// The picture of a setting, cut to the crop.
struct ChartPicture {
  Image image;
  std::vector<float> expected_error;  // of each pixel: the plane `error`
  double seconds = 0, seconds_spread = 0, build_seconds = 0, lookups = 0;
  int runs = 0;
};

class ChartScene {
 public:
  // The three outlive it.
  ChartScene(const SceneDesc& desc, LoadedScene& loaded, Context& context, const ChartOptions& options);

  const SceneDesc& desc() const { return desc_; }
  KnobLimits limits() const { return limits_; }
  int lanes() const { return options_.lanes; }

  // What the setting is expected to cost, in density lookups; to order settings and to say what is left.
  double cost(const Knobs& knobs);

  // Timed: a run that warms up and the picture comes from, then several more, of long ones none. Nothing where `go_on`
  // said no.
  std::optional<ChartPicture> render_timed(const SceneDesc& set, const Progress& go_on);
  std::optional<ChartPicture> render_once(const SceneDesc& set, const Progress& go_on);

  // The samples of some pixels, added to a film of the scene's size. Seconds: of what is done once, whatever the pixels
  // (light grids), and of the pixels.
  struct PixelTimes {
    double once = 0, pixels = 0;
  };
  PixelTimes render_pixels(const SceneDesc& set, Film& film, const WorkList& work);

  // The exact picture's scene and plan: what witnesses are rendered of.
  const PlannedScene& exact_scene(int spp);
  std::string exact_method();  // of its media: "dda_gauss2, homogeneous"

 private:
  struct Stage {
    PlannedScene scene;
    std::shared_ptr<DeviceScene> device;
    PieceErrors piece_errors;
  };
  Stage& stage(const SceneDesc& set);
  std::optional<ChartPicture> render(const SceneDesc& set, bool timed, const Progress& go_on);

  const SceneDesc& desc_;
  LoadedScene& loaded_;
  Context& context_;
  ChartOptions options_;
  KnobLimits limits_;
  // By level of detail and which media are taken as constant.
  std::map<std::pair<int, std::vector<bool>>, std::unique_ptr<Stage>> stages_;
  std::map<std::string, double> build_seconds_;  // by kernel options
};

}  // namespace brume
