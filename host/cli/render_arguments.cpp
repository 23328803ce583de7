// See render_arguments.hpp.
#include "cli/render_arguments.hpp"

#include <CLI/CLI.hpp>
#include <sstream>

#include "base/error.hpp"
#include "base/frame_pattern.hpp"
#include "base/number_text.hpp"
#include "cli/camera_file.hpp"
#include "cli/file_kind.hpp"
#include "cli/picture_error.hpp"
#include "film/film.hpp"
#include "film/film_display.hpp"
#include "scene/families.hpp"

namespace brume {

namespace {

// N integers separated by one character, nothing else.
template <std::size_t N>
std::array<int, N> integers(const std::string& option, const std::string& text, char separator, const char* expected) {
  const InputError refusal(option + ": expected " + expected + ", got '" + text + "'");
  std::array<int, N> values{};
  std::istringstream in(text);
  for (std::size_t i = 0; i < N; ++i) {
    char found = separator;
    if ((i > 0 && (!in.get(found) || found != separator)) || !(in >> values[i])) throw refusal;
  }
  if (in.peek() != std::istringstream::traits_type::eof()) throw refusal;
  return values;
}

std::string number(double value) { return number_text(value, 17); }  // as JSON reads it back

}  // namespace

void RenderArguments::add_scene_options(CLI::App& command) {
  command.add_option("scene", scene, "A " + file_kinds_text())->required();
  command.add_option("--size", size, "Film size WxH in pixels");
  command.add_option("--spp", spp, "Samples per pixel");
  command.add_option("--seed", seed, "Seed of the random numbers");
  command.add_option("--crop", crop, "Render only pixels X0,Y0 (inclusive) to X1,Y1 (exclusive)");
  command.add_option("--camera", camera,
                     "File with a camera object, or a scene: its camera instead of the scene's own");
  command.add_option("--exposure", exposure, "Stops for the display formats");
  command.add_option("--device", device, "Index or part of the name of an OpenCL device (see brume devices)");
  command.add_option("--lanes", lanes, "SIMD lanes inside a work-item; default by device")
      ->check(CLI::IsMember({1, 4, 8, 16}));
  command.add_flag("--generic", generic, "Kernels with every feature, not only those of the scene");
  command.add_option("--set", overrides, "/json/pointer=VALUE: override a value of the scene. Repeatable");
  command.add_flag("--quiet", quiet, "No progress, no notes");
}

void RenderArguments::add_options(CLI::App& command) {
  add_scene_options(command);
  command.add_option("-o,--output", outputs,
                     "Picture: .exr linear float with AOVs; .png, .jpg for display. Repeatable; default NAME.png");
  command.add_option("--frames", frames,
                     "Render a sequence, A-B, A-B:STEP or A: the number of the frame stands for %04d (or %d, %0Nd) in "
                     "-o, in the name of the file, in --camera and in paths of the scene");
  command.add_flag("--overwrite", overwrite, "With --frames: render also those whose pictures are there");
  command.add_option("--samples", samples, "Render only samples A-B (inclusive, from 0) of each pixel");
  command.add_option("--resume", resume, "Go on from a partial picture (.exr): render only what it lacks");
  command.add_flag("--partial", partial,
                   "Keep in .exr what brume merge and --resume need, as --crop, --samples and Ctrl-C do");
  command.add_flag("--trim", trim, "With --crop: those pixels are the whole picture");
  command.add_flag("--alpha", alpha, "Without the background, with a channel A (.exr: multiplied in; .png: not)");
  command.add_option("--aov", aov, "Comma-separated planes for .exr: " + family_names(aov_family()));
  command.add_option("--method", method, "Transmittance method: auto, " + family_names(method_family()));
  command.add_option("--step", step, "Marching step as a share of the medium's longest side");
  command.add_option("--tolerance", tolerance, "Of the method adaptive: how far off a pixel may be, as a share of it");
  command.add_option("--level", level, "Level of detail: voxels averaged over 2^LEVEL of them along each axis");
  command.add_option("--shadow", shadow, "Light inside media: auto, " + family_names(shadow_family()));
  command
      .add_option("--witness", witness,
                  "Pixels that are rendered in double precision to say how far off the picture is; 0: none. Default: " +
                      std::to_string(WITNESS_PIXELS) + ", as far as they take a twentieth of the render's time")
      ->check(CLI::NonNegativeNumber);
  command.add_option("--max-error", max_error,
                     "Choose method, step and light grid that reach this error soonest; --method restricts the choice");
  command.add_option("--error-metric", error_metric, "Which error: " + family_names(error_metric_family()));
  command.add_option("--time-budget", time_budget, "Choose what comes closest in so many seconds of rendering");
  command.add_option("--save-scene", save_scene, "Write the scene that was rendered, to go on from");
  command.add_option("--save-camera", save_camera, "Write the camera, for --camera");
  command.add_option("--stats", stats, "Write times, counts and memory as JSON");
  command.add_flag("--strict", strict,
                   "Exit 1, after writing, if anything had to be noted; of a sequence, stop where a file is damaged");
}

void RenderArguments::complete() {
  const std::string name = scene.stem().string();
  const bool numbered = frames.empty() || frame_pattern(name);
  if (outputs.empty()) outputs.push_back(name + (numbered ? ".png" : "_%04d.png"));
}

RenderArguments RenderArguments::of_frame(int frame) const {
  RenderArguments one = *this;
  one.scene = frame_name(scene.string(), frame);
  one.camera = frame_name(camera.string(), frame);
  for (std::filesystem::path& output : one.outputs) output = frame_name(output.string(), frame);
  one.frames.clear();
  one.stats.clear();
  one.save_scene.clear();
  one.save_camera.clear();
  return one;
}

std::vector<std::string> RenderArguments::all_overrides() const {
  std::vector<std::string> all;
  if (!camera.empty()) all.push_back(camera_override(camera));
  all.insert(all.end(), overrides.begin(), overrides.end());
  if (!size.empty()) {
    const auto wh = integers<2>("--size", size, 'x', "WxH");
    all.push_back("/film/size=[" + std::to_string(wh[0]) + "," + std::to_string(wh[1]) + "]");
  }
  if (spp) all.push_back("/film/spp=" + std::to_string(*spp));
  if (exposure) all.push_back("/film/exposure=" + number(*exposure));
  if (seed) all.push_back("/render/seed=" + std::to_string(*seed));
  if (step) all.push_back("/render/step=" + number(*step));
  if (tolerance) all.push_back("/render/tolerance=" + number(*tolerance));
  if (level) all.push_back("/render/level=" + std::to_string(*level));
  if (max_error) all.push_back("/render/max_error=" + number(*max_error));
  if (time_budget) all.push_back("/render/time_budget=" + number(*time_budget));
  if (!error_metric.empty()) all.push_back("/render/error_metric=\"" + error_metric + "\"");
  if (!method.empty()) all.push_back("/render/method=\"" + method + "\"");
  if (!shadow.empty()) all.push_back("/render/shadow=\"" + shadow + "\"");
  return all;
}

std::array<int, 4> RenderArguments::crop_box() const {
  if (crop.empty() && trim) throw InputError("--trim: expected together with --crop X0,Y0,X1,Y1");
  if (crop.empty()) return {};
  const auto box = integers<4>("--crop", crop, ',', "X0,Y0,X1,Y1");
  if (box[0] >= box[2] || box[1] >= box[3])
    throw InputError("--crop: expected X0 < X1 and Y0 < Y1, got '" + crop + "'");
  return box;
}

std::vector<Aov> aovs_parse(const std::string& text) {
  std::vector<Aov> list;
  std::istringstream names(text);
  for (std::string name; std::getline(names, name, ',');) {
    const FamilyRow* row = family_find(aov_family(), name);
    if (!row) throw InputError("--aov: unknown plane '" + name + "'; known: " + family_names(aov_family()));
    list.push_back(static_cast<Aov>(row->id));
  }
  return list;
}

}  // namespace brume
