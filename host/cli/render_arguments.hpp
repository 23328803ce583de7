// What `brume render` was asked for on the command line.
#pragma once
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "shared/aov.h"

namespace CLI {
class App;
}

namespace brume {

// Comma-separated names, as --aov takes them.
std::vector<Aov> aovs_parse(const std::string& text);

struct RenderArguments {
  std::filesystem::path scene;
  std::vector<std::filesystem::path> outputs;
  std::string size, crop, samples, method, shadow, device, aov, error_metric;
  std::optional<double> exposure, step, tolerance, max_error, time_budget;
  std::optional<int> spp, seed, witness, level;
  int lanes = 0;  // 0: the device's choice
  bool generic = false, quiet = false, strict = false;
  bool trim = false, alpha = false, partial = false, overwrite = false;
  std::vector<std::string> overrides;
  std::filesystem::path stats, save_scene, resume, camera, save_camera;
  std::string frames;  // of a sequence; "": one picture

  void add_options(CLI::App& command);
  // Those of them that say what is rendered and on what, not how and into which files: for other commands too.
  void add_scene_options(CLI::App& command);
  // Without -o the picture is NAME.png in the current folder, of a sequence NAME_%04d.png.
  void complete();
  // Of one frame of a sequence: with its names, and without what there is one of for all frames.
  RenderArguments of_frame(int frame) const;

  // --set and the options that stand for a scene value, as "/json/pointer=VALUE". Reads the file of --camera.
  std::vector<std::string> all_overrides() const;
  std::array<int, 4> crop_box() const;  // all 0: the whole film
  std::vector<Aov> aovs() const { return aovs_parse(aov); }
  // That the render is asked for in part, so that an .exr is to hold what others are joined to.
  bool in_part() const { return !trim && (partial || !crop.empty() || !samples.empty()); }
};

}  // namespace brume
