// brume chart: time against error of every method that fits a scene, into a folder.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/foreign_lines.hpp"
#include "base/interrupt.hpp"
#include "base/out_of_memory.hpp"
#include "base/text_printable.hpp"
#include "chart/chart_run.hpp"
#include "chart/chart_text.hpp"
#include "chart/page.hpp"
#include "cli/command.hpp"
#include "cli/progress.hpp"
#include "cli/render_arguments.hpp"
#include "cli/scene_describe.hpp"
#include "scene/families.hpp"
#include "version.hpp"

namespace brume {

namespace {

struct ChartArguments {
  RenderArguments render;  // of which scene, and on what
  std::filesystem::path folder;
  std::string methods;
  double budget = 0;
  bool overwrite = false, peers = false;

  void say(const std::string& text) const {
    if (!render.quiet) std::fprintf(stderr, "brume: %s\n", text_printable(text).c_str());
  }
};

// `draws`: not after Ctrl-C, which no other program is to wait for.
void chart_write(const ChartArguments& arguments, const Chart& chart, const ChartFolder& folder, bool draws) {
  std::vector<const char*> files{"chart.csv", "chart.json", "chart.html"};
  folder.json_write(chart);
  atomic_write(folder.file("chart.csv"), chart_csv(chart));
  atomic_write(folder.file("chart.html"), chart_page(chart, folder));
  if (draws && chart_plot(chart, folder)) files.insert(files.end(), {"chart.svg", "chart.png"});
  if (draws && files.size() == 3)
    arguments.say("note: without gnuplot there is no chart.svg and no chart.png; chart.html draws its own");
  for (const char* name : files) std::printf("%s\n", folder.file(name).string().c_str());
}

int chart_command_run(const ChartArguments& arguments, const ChartPeers& peers) {
  if (arguments.render.quiet) notes_mute();
  const auto say = [&](const std::string& text) { arguments.say(text); };
  const std::string input = arguments.render.scene.string();
  const std::vector<int> wanted = methods_parse(arguments.methods);
  LoadedScene loaded;
  const SceneDesc desc = with_memory(input, [&] { return scene_describe(arguments.render, loaded, say); });
  if (arguments.peers) peers.check(desc);
  ChartRequest request;
  request.methods = methods_fitting(desc, wanted);
  request.budget = arguments.budget;
  request.say = say;
  const DeviceInfo device = device_choose(arguments.render.device);
  Context context(device);
  const ChartOptions options{lanes_choose(device, arguments.render.lanes), arguments.render.generic,
                             arguments.render.crop_box()};
  ChartScene scene = with_memory(input, [&] { return ChartScene(desc, loaded, context, options); });
  const ChartIdentity identity = identity_of(scene, device.title(), options, VERSION);
  const ChartFolder folder(arguments.folder, identity, arguments.overwrite);
  if (request.methods.empty())
    say("note: the scene has no media that are walked, no method has anything to do: samples per pixel are charted");
  for (const std::string& note : scene.exact_scene(desc.film.spp).all_notes()) say("note: " + note);

  Chart chart;
  {
    ProgressBar bar(arguments.render.quiet);
    request.progress = [&](double share) { bar.show(share); };
    const InterruptRescue rescue([&] {
      if (std::filesystem::exists(folder.file("chart.json")))
        say("what was measured is in " + folder.file("chart.json").string() + "; the same command goes on");
    });
    chart = chart_run(scene, folder, identity, request);
    if (interrupt_requested()) interrupt_claim();
  }
  if (chart.points.empty()) throw Interrupted("interrupted before a point was measured; nothing is written");
  if (arguments.peers && !interrupt_requested()) {
    std::filesystem::create_directories(folder.file("peers"));
    chart.peers = peers.run(desc, loaded, folder.file("peers"));
    if (chart.peers.empty()) say("note: --peers: none of vdb_render and Mitsuba (BRUME_PYTHON) is installed");
  }
  chart_write(arguments, chart, folder, !interrupt_requested());
  if (interrupt_requested())
    throw Interrupted("interrupted; the same command goes on from " + std::to_string(chart.points.size()) + " points");
  if (chart.missing > 0)
    say("note: --budget ended before " + std::to_string(chart.missing) + " of " +
        std::to_string(chart.points.size() + std::size_t(chart.missing)) +
        " points were measured; the same command goes on");
  return 0;
}

}  // namespace

void command_chart(CLI::App& app, Command& run, ChartPeers peers) {
  CLI::App* command = app.add_subcommand("chart", "Chart time against error of every method that fits a scene");
  command->footer(
      "Each point is one setting: its time is the median of 3 to 7 renders (one of more than 20 s stands alone) "
      "without\n"
      "the build of its kernels, its error that against the exact picture with as many samples per pixel. The folder\n"
      "holds chart.csv, chart.json, chart.html and, where gnuplot is, chart.svg and chart.png; the same command goes "
      "on\n"
      "where it was interrupted or its budget ended.");
  auto arguments = std::make_shared<ChartArguments>();
  arguments->render.add_scene_options(*command);
  command->add_option("-o,--output", arguments->folder, "Folder for chart.csv, .json, .html, .svg, .png")->required();
  command->add_option("--methods", arguments->methods, "Only these, comma-separated: " + family_names(method_family()));
  command->add_option("--budget", arguments->budget, "Seconds after which no further point is measured")
      ->check(CLI::PositiveNumber);
  command->add_flag("--overwrite", arguments->overwrite, "Whatever chart the folder holds: begin anew");
  command->add_flag("--peers", arguments->peers,
                    "Other programs on the same scene too, where they are installed: vdb_render, Mitsuba");
  command->callback([arguments, peers, &run] { run = [=] { return chart_command_run(*arguments, peers); }; });
}

}  // namespace brume
