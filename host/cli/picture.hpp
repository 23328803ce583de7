// One picture of a scene that is ready to be rendered: made on the device, measured, written into the files that were
// asked for. What is told when it was interrupted is its caller's.
#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/picture_error.hpp"
#include "cli/render_arguments.hpp"
#include "cli/render_part.hpp"
#include "cli/render_report.hpp"
#include "cli/scene_describe.hpp"
#include "load/loaded_scene.hpp"
#include "plan/planned_scene.hpp"
#include "render/renderer.hpp"

namespace brume {

// A scene as it is to be rendered, with what is to be told of it.
struct Prepared {
  SceneDesc desc;
  PlannedScene flat;
  std::optional<PlannedScene> full;  // without its level of detail, for witnesses
  std::vector<std::string> notes;
  double pilot_s = 0;  // choosing settings for a goal

  const PlannedScene& true_scene() const { return full ? *full : flat; }
};

FlattenOptions flatten_options(const RenderArguments& arguments, int lanes);

// Everything flat, with what there is to note of it.
Prepared prepared_of(const RenderArguments& arguments, const SceneDesc& desc, LoadedScene& loaded, int lanes);

// Settings for a goal, where there is one, then everything flat. `say` is told what is chosen; not the notes.
Prepared prepare(const RenderArguments& arguments, const SceneDesc& asked, LoadedScene& loaded, Context& context,
                 int lanes, const Say& say);

// InputError where --partial asks for what no output can hold.
void part_check(const RenderArguments& arguments, ivec2 size);

class Picture {
 public:
  // Builds kernels and uploads. `sooner`: generic kernels where those of the scene would take longer to build.
  // `note` is told what the picture has to say of itself beyond what `prepared` has noted.
  Picture(const RenderArguments& arguments, const Prepared& prepared, Context& context, int lanes, bool sooner, Say say,
          Say note);

  // Nothing is left to render: it was all in the file of --resume.
  bool work_is_none() const { return work_.empty(); }
  // False where `progress` stopped it.
  bool render(const Progress& progress);
  bool begun() const { return renderer_.stats().primary_rays > 0; }
  // How far off it is; and refines what is further off than asked for. False where that was interrupted.
  bool measure();
  // Its notes, then every output; why one could not be written is added to `failures`. Where it is not complete, an
  // .exr holds what others are joined to.
  void write(bool complete, std::string& failures);

  std::string stats_json(const RunTimes& times) const;
  std::string summary(const RunTimes& times) const;
  const RenderStats& stats() const { return renderer_.stats(); }
  const PictureError& error() const { return error_; }
  bool noted() const { return !notes_.empty(); }
  // The first output that can hold a picture in part; empty where none can.
  std::filesystem::path part_file() const;

 private:
  void write_outputs(const SampleCover* cover, std::string& failures) const;
  void notes_finish();

  const RenderArguments& arguments_;
  const Prepared& prepared_;
  Context& context_;
  Say say_, note_;
  FilmPart part_;
  WorkList work_;
  Renderer renderer_;
  PictureError error_;
  std::vector<std::string> notes_;
};

// Adds why `write` failed to `failures`, and goes on: what else is done is not lost.
void attempt(std::string& failures, const std::filesystem::path& file, const std::function<void()>& write);

// Whether 8 bits are all that is seen of the picture: not the last digits, in which generic kernels round otherwise.
bool only_displayed(const RenderArguments& arguments);

}  // namespace brume
