// brume render: scene (or bare volume, or mesh) → pictures. Reads as the pipeline: description → flat → device → film →
// images.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <functional>
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
#include "cli/command.hpp"
#include "cli/file_kind.hpp"
#include "cli/output_files.hpp"
#include "cli/picture_goal.hpp"
#include "cli/progress.hpp"
#include "cli/render_arguments.hpp"
#include "cli/render_part.hpp"
#include "cli/render_report.hpp"
#include "cli/scene_describe.hpp"
#include "film/film_partial.hpp"
#include "film/film_write.hpp"
#include "image/image_format.hpp"
#include "load/load_ahead.hpp"
#include "plan/planned_scene.hpp"
#include "render/renderer.hpp"
#include "scene/scene_writer.hpp"

namespace brume {

namespace {

void say(const RenderArguments& arguments, const std::string& text) {
  if (!arguments.quiet) std::fprintf(stderr, "brume: %s\n", text_printable(text).c_str());
}

std::string size_text(glm::ivec2 size) { return std::to_string(size.x) + " x " + std::to_string(size.y) + " pixels"; }

// Adds why `write` failed to `failures`, and goes on: what else is done is not lost.
template <class Write>
void attempt(std::string& failures, const std::filesystem::path& file, Write write) {
  try {
    with_memory(file.string(), write);
  } catch (const RuntimeError& error) {
    failures += (failures.empty() ? "" : "; ") + std::string(error.what());
  }
}

// cover: where the picture is one in part, what of it there is.
void write_outputs(const RenderArguments& arguments, const SceneDesc& desc, const PlannedScene& flat, const Film& film,
                   const SampleCover* cover, const Context& context, const RenderStats& stats,
                   const PictureError& error, std::string& failures) {
  FilmWriteOptions options;
  options.cover = cover;
  options.exposure = desc.film.exposure;
  options.aovs = arguments.aovs();
  options.alpha = arguments.alpha;
  const Frame& frame = flat.frame;
  const Film trimmed =
      arguments.trim ? film.cut({frame.crop_x0, frame.crop_y0}, {frame.crop_x1, frame.crop_y1}) : Film({0, 0});
  if (!arguments.trim) options.window = {frame.crop_x0, frame.crop_y0, frame.crop_x1, frame.crop_y1};
  options.metadata = render_metadata(desc, flat, context.device(), stats, error);
  if (cover) {
    options.window = cover->window(film.size().x);
    for (const auto& entry : part_metadata(desc, flat))
      if (!metadata_find(options.metadata, entry.first)) options.metadata.push_back(entry);
  }
  for (const std::filesystem::path& output : arguments.outputs)
    attempt(failures, output, [&] {
      film_write(arguments.trim ? trimmed : film, output, options);
      std::printf("%s\n", output.string().c_str());
    });
}

void check_outputs(const RenderArguments& arguments) {
  std::vector<NamedFile> files;
  for (const std::filesystem::path& output : arguments.outputs) files.push_back({"-o", output});
  files.insert(files.end(), {{"--stats", arguments.stats}, {"--save-scene", arguments.save_scene}});
  output_files_check(files, {{"the input", arguments.scene}});
  for (const std::filesystem::path& output : arguments.outputs) image_check_writable(output);
  if (!arguments.stats.empty()) AtomicFile(arguments.stats);
}

// The first output that can hold a picture in part; empty where none can.
std::filesystem::path part_output(const RenderArguments& arguments, ivec2 size) {
  if (arguments.trim || !part_size_problem(size, film_channels(arguments.aovs(), arguments.alpha)).empty()) return {};
  for (const std::filesystem::path& output : arguments.outputs)
    if (image_format_of_output(output).output == ImageOutput::LINEAR) return output;
  return {};
}

// Whether 8 bits are all that is seen of the picture: not the last digits, in which generic kernels round otherwise.
bool only_displayed(const RenderArguments& arguments) {
  return std::all_of(arguments.outputs.begin(), arguments.outputs.end(), [](const std::filesystem::path& output) {
    return image_format_of_output(output).output == ImageOutput::DISPLAY;
  });
}

void check_part(const RenderArguments& arguments, ivec2 size) {
  if (!arguments.partial || !part_output(arguments, size).empty()) return;
  if (arguments.trim) throw InputError("--partial: a picture cut out by --trim cannot be joined to others");
  const std::string problem = part_size_problem(size, film_channels(arguments.aovs(), arguments.alpha));
  throw InputError("--partial: " + (problem.empty() ? "expected an output of type .exr" : problem));
}

std::string resume_hint(const std::filesystem::path& file) {
  return file.empty() ? "" : "; the same command with --resume " + file.string() + " goes on";
}

// With progress, until Ctrl-C; where the device does not answer that, what is done is written from outside. Then, of a
// picture that is complete, `measure`.
bool render_film(const RenderArguments& arguments, Renderer& renderer, const WorkList& work, Film& film,
                 const std::function<void()>& write, const std::function<void()>& measure) {
  if (work.empty()) return true;
  ProgressBar bar(arguments.quiet);
  const InterruptRescue rescue([&] {
    if (renderer.stats().primary_rays == 0) return;
    try {
      write();
    } catch (const std::exception& error) {
      say(arguments, error.what());
    }
  });
  const bool complete = renderer.render(film, work, [&](double share) {
    bar.show(share);
    return !interrupt_requested();
  });
  if (complete) measure();
  interrupt_claim();
  if (renderer.stats().primary_rays == 0) throw Interrupted("interrupted before a pixel was done; nothing is written");
  return complete;
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
  check_part(arguments, asked.film.size);
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
  check_part(arguments, described.film.size);
  if (failure) std::rethrow_exception(failure);
  return {described, *device};
}

// A scene as it is to be rendered, with what is to be told of it.
struct Prepared {
  SceneDesc desc;
  PlannedScene flat;
  std::vector<std::string> notes;
  double pilot_s = 0;
};

Prepared prepare(const RenderArguments& arguments, const SceneDesc& asked, LoadedScene& loaded, Context& context,
                 int lanes) {
  Prepared made;
  const std::string input = arguments.scene.string();
  const auto told = [&](const std::string& text) { say(arguments, text); };
  const Stopwatch pilot;
  loaded.needed_again = asked.render.has_goal();
  made.desc =
      with_memory(input, [&] { return picture_for_goal(arguments, asked, loaded, context, lanes, made.notes, told); });
  made.pilot_s = pilot.seconds();
  if (!arguments.save_scene.empty())
    atomic_write(arguments.save_scene, scene_write(made.desc, arguments.save_scene.parent_path()));
  loaded.needed_again = false;  // one picture needs the files no longer
  made.flat = with_memory(input, [&] {
    return flatten(made.desc, loaded,
                   {bvh_width_for(lanes), arguments.crop_box(), arguments.alpha, arguments.witness != 0});
  });
  for (const std::string& note : made.flat.all_notes()) made.notes.push_back(note);
  for (const std::string& note : made.notes) told("note: " + note);
  return made;
}

// And refines what is further off than asked for. False where it was interrupted.
bool error_measure(const RenderArguments& arguments, const Prepared& prepared, const Renderer& renderer,
                   Context& context, Film& film, PictureError& error) {
  const SceneDesc& desc = prepared.desc;
  try {
    if (!arguments.samples.empty()) return true;
    error = picture_error(prepared.flat, film, arguments.witness, renderer.stats().render_s, desc.render);
    // What is refined is no sum of the samples that parts are joined of.
    if (!arguments.in_part() && arguments.resume.empty())
      picture_refine_for_goal(arguments, desc, prepared.flat, context, renderer, film, error,
                              [&](const std::string& text) { say(arguments, text); });
    return true;
  } catch (const Interrupted&) {
    return false;
  }
}

int picture_make(const RenderArguments& arguments, const Prepared& prepared, Context& context, int lanes,
                 RunTimes& times, const Stopwatch& total) {
  const SceneDesc& desc = prepared.desc;
  const PlannedScene& flat = prepared.flat;
  std::vector<std::string> notes = prepared.notes;
  FilmPart part =
      with_memory("a film of " + size_text(desc.film.size), [&] { return part_begin(arguments.resume, desc, flat); });
  Film& film = part.film;
  const WorkList work = work_missing(flat.frame, samples_parse(arguments.samples, desc.film.spp), part.cover);
  const std::filesystem::path part_file = part_output(arguments, desc.film.size);

  Renderer renderer(context, flat, {lanes, arguments.generic, 0, only_displayed(arguments)});
  PictureError error;
  const auto write = [&](bool complete) {
    const std::size_t known = notes.size();
    if (dropped_count(renderer.stats())) notes.push_back(dropped_note(renderer.stats(), flat.frame.cutoff));
    if (renderer.stats().invalid_samples > 0) notes.push_back(invalid_note(renderer.stats()));
    if (const std::string note = goal_missed_note(desc.render, error.witness); !note.empty()) notes.push_back(note);
    for (std::size_t i = known; i < notes.size(); ++i) say(arguments, "note: " + notes[i]);
    std::string failures;
    std::optional<SampleCover> cover;
    if (!part_file.empty() && (arguments.in_part() || !complete)) cover = cover_after(part.cover, work, film);
    write_outputs(arguments, desc, flat, film, cover ? &*cover : nullptr, context, renderer.stats(), error, failures);
    times.total_s = total.seconds();
    if (!arguments.stats.empty())
      attempt(failures, arguments.stats, [&] {
        atomic_write(arguments.stats, render_stats_json(desc, flat, context.device(), renderer.stats(), error, times));
      });
    if (!failures.empty()) throw RuntimeError(failures);
  };
  const auto rescue = [&] {
    write(false);
    std::fprintf(stderr, "brume: %s\n",
                 text_printable("what was done has been written" + resume_hint(part_file)).c_str());
  };
  bool unknown = false;  // an interruption left the error of a complete picture open
  const bool complete = render_film(arguments, renderer, work, film, rescue, [&] {
    unknown = !error_measure(arguments, prepared, renderer, context, film, error);
  });
  write(complete);
  say(arguments, render_summary(desc, flat, context.device(), renderer.stats(), error, times));
  if (unknown) throw Interrupted("interrupted; the picture is complete and written, its error is not known");
  if (!complete) throw Interrupted("interrupted; what was done has been written" + resume_hint(part_file));
  return arguments.strict && !notes.empty() ? 1 : 0;
}

int render_run(RenderArguments arguments) {
  Stopwatch total, lap;
  arguments.complete();
  if (arguments.quiet) notes_mute();
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
  const Prepared prepared = prepare(arguments, asked, loaded, context, lanes);
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
