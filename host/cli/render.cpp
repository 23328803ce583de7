// brume render: scene (or bare volume, or mesh) → pictures. Reads as the pipeline: description → flat → device → film →
// images. Of a sequence: sequence.cpp.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <future>
#include <memory>
#include <optional>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/foreign_lines.hpp"
#include "base/interrupt.hpp"
#include "base/out_of_memory.hpp"
#include "base/stopwatch.hpp"
#include "base/text_printable.hpp"
#include "cli/camera_file.hpp"
#include "cli/command.hpp"
#include "cli/file_kind.hpp"
#include "cli/output_files.hpp"
#include "cli/picture.hpp"
#include "cli/progress.hpp"
#include "cli/render_arguments.hpp"
#include "cli/scene_describe.hpp"
#include "cli/sequence.hpp"
#include "cli/sequence_scene.hpp"
#include "image/image_format.hpp"
#include "load/load_ahead.hpp"
#include "scene/scene_writer.hpp"

namespace brume {

namespace {

void say(const RenderArguments& arguments, const std::string& text) {
  if (!arguments.quiet) std::fprintf(stderr, "brume: %s\n", text_printable(text).c_str());
}

void check_outputs(const RenderArguments& arguments) {
  std::vector<NamedFile> files;
  for (const std::filesystem::path& output : arguments.outputs) files.push_back({"-o", output});
  files.insert(
      files.end(),
      {{"--stats", arguments.stats}, {"--save-scene", arguments.save_scene}, {"--save-camera", arguments.save_camera}});
  output_files_check(files, {{"the input", arguments.scene}, {"--camera", arguments.camera}});
  for (const std::filesystem::path& output : arguments.outputs) image_check_writable(output);
  if (!arguments.stats.empty()) AtomicFile(arguments.stats);
}

std::string resume_hint(const std::filesystem::path& file) {
  return file.empty() ? "" : "; the same command with --resume " + file.string() + " goes on";
}

// The description of what is to be rendered and the device that renders it, found while files are read: OpenCL is
// called from this thread only. Where both fail it is the file's failure that is told.
struct Begun {
  SceneDesc asked;
  DeviceInfo device;
};

// A scene says which files it needs before they are read.
Begun begin_scene(const RenderArguments& arguments, LoadedScene& loaded) {
  const SceneDesc asked = scene_describe(arguments, loaded, {});
  part_check(arguments, asked.film.size);
  const LoadAhead ahead(loaded, asked);
  return {asked, device_choose(arguments.device)};
}

// A bare file has to be read to be described.
Begun begin_bare(const RenderArguments& arguments, LoadedScene& loaded) {
  std::string report;
  std::future<SceneDesc> asked = std::async(std::launch::async, [&] {
    return scene_describe(arguments, loaded, [&](const std::string& text) { report = text; });
  });
  std::optional<DeviceInfo> device;
  std::exception_ptr failure;
  try {
    device = device_choose(arguments.device);
  } catch (const std::exception&) {
    failure = std::current_exception();
  }
  const SceneDesc described = asked.get();
  say(arguments, report);
  part_check(arguments, described.film.size);
  if (failure) std::rethrow_exception(failure);
  return {described, *device};
}

void write_all(const RenderArguments& arguments, Picture& picture, bool complete, RunTimes& times,
               const Stopwatch& total) {
  std::string failures;
  picture.write(complete, failures);
  times.total_s = total.seconds();
  if (!arguments.stats.empty())
    attempt(failures, arguments.stats, [&] { atomic_write(arguments.stats, picture.stats_json(times)); });
  if (!failures.empty()) throw RuntimeError(failures);
}

// With progress, until Ctrl-C; where the device does not answer that, what is done is written from outside. Of a
// picture that is complete, its error: `unknown` where an interruption left that open.
bool render_picture(const RenderArguments& arguments, Picture& picture, RunTimes& times, const Stopwatch& total,
                    bool& unknown) {
  if (picture.work_is_none()) return true;
  ProgressBar bar(arguments.quiet);
  const InterruptRescue rescue([&] {
    if (!picture.begun()) return;
    try {
      write_all(arguments, picture, false, times, total);
      std::fprintf(stderr, "brume: %s\n",
                   text_printable("what was done has been written" + resume_hint(picture.part_file())).c_str());
    } catch (const std::exception& error) {
      say(arguments, error.what());
    }
  });
  const bool complete = picture.render([&](double share) {
    bar.show(share);
    return !interrupt_requested();
  });
  if (complete) unknown = !picture.measure();
  interrupt_claim();
  if (!picture.begun()) throw Interrupted("interrupted before a pixel was done; nothing is written");
  return complete;
}

int picture_make(const RenderArguments& arguments, const Prepared& prepared, Context& context, int lanes,
                 RunTimes& times, const Stopwatch& total) {
  const auto told = [&](const std::string& text) { say(arguments, text); };
  const auto noted = [&](const std::string& note) { told("note: " + note); };
  for (const std::string& note : prepared.notes) noted(note);
  Picture picture(arguments, prepared, context, lanes, only_displayed(arguments), told, noted);
  bool unknown = false;
  const bool complete = render_picture(arguments, picture, times, total, unknown);
  write_all(arguments, picture, complete, times, total);
  told(picture.summary(times));
  if (unknown) throw Interrupted("interrupted; the picture is complete and written, its error is not known");
  if (!complete) throw Interrupted("interrupted; what was done has been written" + resume_hint(picture.part_file()));
  return arguments.strict && picture.noted() ? 1 : 0;
}

int render_run(RenderArguments arguments) {
  Stopwatch total, lap;
  arguments.complete();
  if (arguments.quiet) notes_mute();
  if (!arguments.frames.empty()) return sequence_render(arguments);
  sequence_refuse(arguments);
  check_outputs(arguments);
  const std::string input = arguments.scene.string();
  LoadedScene loaded;
  loaded.needed_again = false;  // one picture needs the files no longer
  const auto [asked, device] = with_memory(input, [&] {
    return file_kind(arguments.scene) == FileKind::SCENE ? begin_scene(arguments, loaded)
                                                         : begin_bare(arguments, loaded);
  });
  const int lanes = lanes_choose(device, arguments.lanes);
  Context context(device);
  const Prepared prepared =
      prepare(arguments, asked, loaded, context, lanes, [&](const std::string& text) { say(arguments, text); });
  if (!arguments.save_scene.empty())
    atomic_write(arguments.save_scene, scene_write(prepared.desc, arguments.save_scene.parent_path()));
  if (!arguments.save_camera.empty()) camera_save(arguments.save_camera, prepared.desc.camera);
  loaded = {};
  RunTimes times;
  times.pilot_s = prepared.pilot_s;
  times.load_s = lap.lap() - times.pilot_s;
  return picture_make(arguments, prepared, context, lanes, times, total);
}

}  // namespace

void command_render(CLI::App& app, Command& run) {
  CLI::App* command = app.add_subcommand("render", "Render a " + file_kinds_text());
  auto arguments = std::make_shared<RenderArguments>();
  arguments->add_options(*command);
  command->callback([arguments, &run] { run = [arguments] { return render_run(*arguments); }; });
}

}  // namespace brume
