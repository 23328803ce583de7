// See sequence_scene.hpp.
#include "cli/sequence_scene.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "cli/file_kind.hpp"
#include "load/scene_files.hpp"
#include "scene/scene_writer.hpp"

namespace brume {

namespace {

namespace fs = std::filesystem;

const char* const EXAMPLE = "%04d, or %0Nd with N other digits";

bool is_there(const fs::path& file) {
  std::error_code failed;
  return fs::exists(file, failed);
}

struct NamedPath {
  const char* option;
  fs::path file;
};

// A bare file of many: of those that can be read the largest, which is likely to show most of what is to come.
SceneText text_around_bare(const RenderArguments& arguments, const std::vector<int>& frames, const Say& say) {
  std::vector<std::pair<std::uintmax_t, fs::path>> files;
  for (const int frame : frames) {
    const fs::path file = frame_name(arguments.scene.string(), frame);
    std::error_code failed;
    if (const std::uintmax_t bytes = fs::file_size(file, failed); !failed) files.emplace_back(bytes, file);
  }
  if (files.empty()) throw InputError(arguments.scene.string() + ": no file is there of " + frames_name(frames));
  std::stable_sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::string failure;
  for (const auto& [bytes, file] : files) {
    RenderArguments one = arguments;
    one.scene = file;
    LoadedScene loaded;
    try {
      return scene_text(one, arguments.scene, loaded, [&](const std::string& text) { say("for all frames: " + text); });
    } catch (const InputError& error) {
      if (failure.empty()) failure = error.what();
    }
  }
  throw InputError(failure);
}

}  // namespace

void sequence_refuse(const RenderArguments& arguments) {
  std::vector<NamedPath> names{{"", arguments.scene}, {"--camera ", arguments.camera}};
  for (const fs::path& output : arguments.outputs) names.push_back({"-o ", output});
  for (const NamedPath& name : names)
    if (frame_pattern(name.file.string()))
      throw InputError(name.option + name.file.string() +
                       ": names the files of a sequence, expected together with --frames, e.g. --frames 1-60");
}

void sequence_check(const RenderArguments& arguments) {
  for (const fs::path& output : arguments.outputs)
    if (!frame_pattern(output.filename().string()))
      throw InputError("-o " + output.string() +
                       ": with --frames expected a place for the number of the frame: " + EXAMPLE);
  if (!arguments.resume.empty()) throw InputError("--resume: expected without --frames, which keeps finished frames");
  const NamedPath ones[] = {{"--stats ", arguments.stats},
                            {"--save-scene ", arguments.save_scene},
                            {"--save-camera ", arguments.save_camera}};
  for (const NamedPath& one : ones)
    if (frame_pattern(one.file.string()))
      throw InputError(one.option + one.file.string() + ": there is one for all frames, expected a name without %");
}

SequenceScene::SequenceScene(const RenderArguments& arguments, const std::vector<int>& frames, const Say& say)
    : arguments_(arguments) {
  const bool scene_each = frame_pattern(arguments.scene.string());
  LoadedScene loaded;
  if (file_kind(arguments.scene) != FileKind::SCENE && scene_each)
    text_ = text_around_bare(arguments, frames, say);
  else if (!scene_each)
    text_ = scene_text(arguments, arguments.scene, loaded, say);
  const bool camera_each = frame_pattern(arguments.camera.string());
  if (scene_each || camera_each) return;
  if (scene_write(describe_all(frames.front()), "") == scene_write(describe(frames.front()), ""))
    throw InputError(arguments.scene.string() + ": --frames, but nothing differs from frame to frame: expected " +
                     EXAMPLE + " in the name of a file that it reads");
}

SceneText SequenceScene::text_of(int frame) const {
  if (!text_.file.empty()) return text_;
  LoadedScene loaded;
  const RenderArguments one = arguments_.of_frame(frame);
  return scene_text(one, one.scene, loaded, [](const std::string&) {});
}

SceneDesc SequenceScene::describe(int frame) const {
  return scene_of_text(text_of(frame), arguments_.of_frame(frame).all_overrides(), frame);
}

SceneDesc SequenceScene::describe_all(int camera_of) const {
  return scene_of_text(text_, arguments_.of_frame(camera_of).all_overrides(), FRAME_ANY);
}

std::vector<fs::path> SequenceScene::missing(int frame) const {
  const RenderArguments one = arguments_.of_frame(frame);
  std::vector<fs::path> needed{one.scene};
  if (!one.camera.empty()) needed.push_back(one.camera);
  const auto absent = [](std::vector<fs::path> files) {
    files.erase(std::remove_if(files.begin(), files.end(), is_there), files.end());
    return files;
  };
  if (const std::vector<fs::path> first = absent(needed); !first.empty()) return first;
  return absent(files(frame));
}

std::vector<fs::path> SequenceScene::files(int frame) const {
  try {
    return scene_files(describe(frame)).paths();
  } catch (const InputError&) {
    return {};
  }
}

std::vector<int> frames_finished(const RenderArguments& arguments, const std::vector<int>& frames) {
  std::vector<int> finished;
  for (const int frame : frames) {
    const std::vector<fs::path> outputs = arguments.of_frame(frame).outputs;
    if (std::all_of(outputs.begin(), outputs.end(), is_there)) finished.push_back(frame);
  }
  return finished;
}

std::map<int, std::vector<fs::path>> frames_missing(const SequenceScene& scene, const std::vector<int>& frames) {
  std::map<int, std::vector<fs::path>> missing;
  for (const int frame : frames)
    if (const std::vector<fs::path> files = scene.missing(frame); !files.empty()) missing[frame] = files;
  if (!frames.empty() && missing.size() == frames.size())
    throw InputError(missing.begin()->second.front().string() + ": " + NOT_THERE + ", nor is that of any other of " +
                     frames_name(frames));
  return missing;
}

}  // namespace brume
