// brume bench: throughput and accuracy of brume, and of others on the same work.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/number_text.hpp"
#include "base/streams.hpp"
#include "benchmarks.hpp"
#include "cli/command.hpp"
#include "compare.hpp"
#include "render/renderer.hpp"
#include "roofline.hpp"
#include "scaling.hpp"
#include "scratch.hpp"
#include "specialised.hpp"
#include "version.hpp"

namespace brume {

namespace {

using namespace bench;

struct BenchArguments {
  std::string device;
  std::filesystem::path json, scaling, roofline;
  std::vector<std::filesystem::path> compare, kernels;
  BenchOptions options;
  int size = 512, most = 256;
  bool has_size = false;

  int run() const;
};

constexpr std::size_t NAME_WIDTH = 48;

void print(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  stdout_flush();
}

int bench_run(const BenchArguments& arguments) {
  if (!arguments.json.empty()) AtomicFile probe(arguments.json);  // not after an hour
  const Scratch scratch;
  const std::vector<Workload> all = workloads(scratch.path(), arguments.size);
  const DeviceInfo device = device_choose(arguments.device);
  Results results{VERSION, device.title(), device.driver, device.compute_units, lanes_choose(device, 0), arguments.size,
                  {}};
  const std::string side = std::to_string(results.size);
  const auto begin = [&] {
    print(device.title() + ", driver " + device.driver + ", " + std::to_string(results.lanes) + " lanes, " + side +
          " x " + side + " pixels\n\n" + rows_header(NAME_WIDTH));
  };
  results.rows = benchmarks_run(device, all, arguments.options, scratch.path(), begin,
                                [](const Row& row) { print(row_text(row, NAME_WIDTH)); });
  print(rows_legend());
  if (!arguments.json.empty()) atomic_write(arguments.json, results_json(results));
  return 0;
}

int bench_compare(const BenchArguments& arguments) {
  print(results_compare(results_read(arguments.compare[0]), results_read(arguments.compare[1])));
  return 0;
}

int bench_kernels(const BenchArguments& arguments) {
  if (!arguments.json.empty()) AtomicFile probe(arguments.json);
  const Scratch scratch;
  const DeviceInfo device = device_choose(arguments.device);
  print(device.title() + ", driver " + device.driver + "\n\n" + specialised_header());
  const SpecialisedOptions options{arguments.device, arguments.has_size ? arguments.size : 0,
                                   arguments.options.repetitions};
  const std::vector<SpecialisedRow> rows = specialised_run(
      arguments.kernels, options, scratch.path(), [](const SpecialisedRow& row) { print(specialised_text(row)); });
  print(specialised_legend());
  if (!arguments.json.empty()) atomic_write(arguments.json, specialised_json(rows));
  return 0;
}

void print_axis_end(const ScalingAxis& axis) {
  const auto text = [](const std::optional<double>& exponent) { return exponent ? number_text(*exponent, 3) : "?"; };
  const double measured = axis.exponent().value_or(axis.expected);
  print("  exponent " + text(axis.exponent()) + ", of lookups " + text(axis.lookups_exponent()) + "; expected " +
        number_text(axis.expected) + ": " + axis.because +
        (measured > axis.expected + SCALING_WORSE ? "\n  WORSE, suspect " + axis.suspect + "\n\n" : "\n\n"));
}

int bench_scaling(const BenchArguments& arguments) {
  std::filesystem::create_directories(arguments.scaling);
  const auto file = [&](const char* name) { return arguments.scaling / name; };
  const AtomicFile writable(file("scaling.json"));  // not after minutes
  const Scratch scratch;
  const DeviceInfo device = device_choose(arguments.device);
  print(device.title() + ", driver " + device.driver + "\n\n");
  const std::vector<ScalingAxis> axes = scaling_run(
      {arguments.device, arguments.options.repetitions, arguments.most}, scratch.path(),
      [](const ScalingAxis& axis) { print(axis.name + "\n"); },
      [](const ScalingPoint& point) {
        print(column(std::to_string(point.value), 8) + column(seconds_text(point.seconds), 12) +
              column(point.spread > 0 ? share_text(point.spread / point.seconds) : "-", 10) +
              column(number_text(point.lookups, 3), 12) + " lookups\n");
      },
      print_axis_end);
  atomic_write(file("scaling.json"), scaling_json(device.title(), axes));
  print(file("scaling.json").string() + "\n");
  if (scaling_plot(device.title(), axes, file("scaling.svg"), file("scaling.png")))
    print(file("scaling.svg").string() + "\n" + file("scaling.png").string() + "\n");
  return 0;
}

int bench_roofline(const BenchArguments& arguments) {
  std::filesystem::create_directories(arguments.roofline);
  const auto file = [&](const char* name) { return arguments.roofline / name; };
  const std::filesystem::path json = arguments.json.empty() ? file("roofline.json") : arguments.json;
  for (const std::filesystem::path& wanted : {json, file("roofline.svg")}) AtomicFile probe(wanted);
  const Scratch scratch;
  const DeviceInfo device = device_choose(arguments.device);
  print(device.title() + ", driver " + device.driver + "\n\n" + roofline_header());
  const std::vector<RooflineRow> rows =
      roofline_run(device, {arguments.size, arguments.options.repetitions}, scratch.path(),
                   [](const RooflineRow& row) { print(roofline_text(row)); });
  print(roofline_legend(rows));
  Results results{VERSION, device.title(), device.driver, device.compute_units, lanes_choose(device, 0), arguments.size,
                  {}};
  for (const RooflineRow& row : rows) results.rows.push_back(row.row);
  atomic_write(json, results_json(results));
  print("\n" + json.string() + "\n");
  if (roofline_plot(device.title(), rows, file("roofline.svg"), file("roofline.png")))
    print(file("roofline.svg").string() + "\n" + file("roofline.png").string() + "\n");
  return 0;
}

int BenchArguments::run() const {
  if (!roofline.empty()) return bench_roofline(*this);
  if (!scaling.empty()) return bench_scaling(*this);
  if (!compare.empty()) return bench_compare(*this);
  return kernels.empty() ? bench_run(*this) : bench_kernels(*this);
}

}  // namespace

void command_bench(CLI::App& app, Command& run) {
  CLI::App* command = app.add_subcommand("bench", "Measure time and error of every method on set work");
  auto arguments = std::make_shared<BenchArguments>();
  BenchOptions& options = arguments->options;
  command->add_option("--device", arguments->device, "Index or part of the name of an OpenCL device");
  command->add_option("--filter", options.filter, "Only benchmarks whose name matches this expression");
  command->add_option("--json", arguments->json, "Write the results as JSON");
  CLI::Option* size = command->add_option("--size", arguments->size, "Pixels per side");
  size->check(CLI::Range(16, 4096));
  command
      ->add_option("--repetitions", options.repetitions,
                   "Runs of each, of those that trace light a third; the median counts")
      ->check(CLI::Range(1, 100));
  command->add_flag("--peers", options.peers,
                    "Run vdb_render, Mitsuba, VTK and Embree on the same work too, where they are installed");
  command
      ->add_option("--compare", arguments->compare,
                   "Measure nothing: what changed from one --json to another by more than its noise")
      ->expected(2)
      ->type_name("BEFORE.json AFTER.json");
  command
      ->add_option("--kernels", arguments->kernels,
                   "Measure these scenes instead: what building and rendering takes with kernels of their own and with "
                   "generic ones")
      ->type_name("SCENE...")
      ->check(CLI::ExistingFile)
      ->excludes("--compare");
  command
      ->add_option("--scaling", arguments->scaling,
                   "Measure how the time of a fog grows with pixels, steps, voxels, lights, media and threads instead: "
                   "scaling.json, .svg and .png in this folder")
      ->type_name("DIR")
      ->excludes("--compare")
      ->excludes("--kernels");
  command
      ->add_option("--roofline", arguments->roofline,
                   "Measure how near the parts of brume come to what the device allows instead: roofline.json, .svg "
                   "and .png in this folder")
      ->type_name("DIR")
      ->excludes("--compare")
      ->excludes("--kernels")
      ->excludes("--scaling");
  command->add_option("--most", arguments->most, "Of --scaling: the largest number of anything")
      ->check(CLI::Range(2, 1024));
  command->callback([arguments, size, &run] {
    arguments->has_size = size->count() > 0;
    run = [arguments] { return arguments->run(); };
  });
}

}  // namespace brume
