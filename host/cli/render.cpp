// brume render: scene (or bare volume, or mesh) → pictures. Reads as the pipeline: description → flat → device → film → images.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/interrupt.hpp"
#include "base/stopwatch.hpp"
#include "cli/command.hpp"
#include "cli/progress.hpp"
#include "cli/render_arguments.hpp"
#include "cli/render_report.hpp"
#include "film/film_write.hpp"
#include "flat/bare_scene.hpp"
#include "flat/flatten.hpp"
#include "render/renderer.hpp"
#include "scene/scene_reader.hpp"
#include "scene/scene_writer.hpp"

namespace brume {

namespace {

void say(const RenderArguments& arguments, const std::string& text) {
  if (!arguments.quiet) std::fprintf(stderr, "brume: %s\n", text.c_str());
}

// That of the overrides: the camera of a bare file depends on its shape.
ivec2 film_size(const RenderArguments& arguments) {
  std::vector<std::string> film;
  for (const std::string& override : arguments.all_overrides())
    if (override.rfind("/film", 0) == 0) film.push_back(override);
  return scene_read_text("{}", arguments.scene, film).film.size;
}

SceneDesc describe(const RenderArguments& arguments) {
  if (!bare_scene_takes(arguments.scene)) return scene_read(arguments.scene, arguments.all_overrides());
  std::string report;
  const SceneDesc bare = bare_scene(arguments.scene, report, film_size(arguments));
  say(arguments, report);
  const std::filesystem::path folder = arguments.scene.parent_path();
  SceneDesc desc = scene_read_text(scene_write(bare, folder), folder / (arguments.scene.filename().string() + ".json"),
                                   arguments.all_overrides());
  desc.file = arguments.scene;
  return desc;
}

void write_outputs(const RenderArguments& arguments, const SceneDesc& desc, const FlatScene& flat, const Film& film,
                   const Context& context, const RenderStats& stats) {
  FilmWriteOptions options;
  options.exposure = desc.film.exposure;
  options.aovs = arguments.aovs();
  options.metadata = render_metadata(desc, flat, context.device(), stats);
  for (const std::filesystem::path& output : arguments.outputs) {
    film_write(film, output, options);
    std::printf("%s\n", output.string().c_str());
  }
}

int render_run(RenderArguments arguments) {
  Stopwatch total, lap;
  arguments.complete();
  for (const std::filesystem::path& output : arguments.outputs) image_check_writable(output);
  if (!arguments.stats.empty()) AtomicFile(arguments.stats);
  const SceneDesc desc = describe(arguments);
  if (!arguments.save_scene.empty())
    atomic_write(arguments.save_scene, scene_write(desc, arguments.save_scene.parent_path()));

  const DeviceInfo device = device_choose(arguments.device);
  const int lanes = lanes_choose(device, arguments.lanes);
  const FlatScene flat = flatten(desc, {bvh_width_for(lanes), arguments.crop_box()});
  for (const std::string& note : flat.notes) say(arguments, "note: " + note);
  RunTimes times;
  times.load_s = lap.lap();

  Context context(device);
  Renderer renderer(context, flat, {lanes, arguments.generic, 0});
  Film film(desc.film.size);
  bool complete;
  {
    ProgressBar bar(arguments.quiet);
    complete = renderer.render(film, [&bar](double share) {
      bar.show(share);
      return !interrupt_requested();
    });
  }
  write_outputs(arguments, desc, flat, film, context, renderer.stats());
  times.total_s = total.seconds();
  if (!arguments.stats.empty())
    atomic_write(arguments.stats, render_stats_json(desc, flat, device, renderer.stats(), times));
  say(arguments, render_summary(desc, flat, device, renderer.stats(), times));
  if (!complete) throw Interrupted("interrupted; what was done has been written");
  return 0;
}

}  // namespace

void command_render(CLI::App& app, Command& run) {
  CLI::App* command = app.add_subcommand("render", "Render a scene, a volume (.vdb) or a mesh (.obj)");
  auto arguments = std::make_shared<RenderArguments>();
  arguments->add_options(*command);
  command->callback([arguments, &run] { run = [arguments] { return render_run(*arguments); }; });
}

}  // namespace brume
