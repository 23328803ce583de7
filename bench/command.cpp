// brume bench: throughput and accuracy of brume, and of others on the same work.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/streams.hpp"
#include "benchmarks.hpp"
#include "cli/command.hpp"
#include "compare.hpp"
#include "render/renderer.hpp"
#include "scratch.hpp"
#include "version.hpp"

namespace brume {

namespace {

using namespace bench;

struct BenchArguments {
  std::string device;
  std::filesystem::path json;
  std::vector<std::filesystem::path> compare;
  BenchOptions options;
  int size = 512;
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

}  // namespace

void command_bench(CLI::App& app, Command& run) {
  CLI::App* command = app.add_subcommand("bench", "Measure time and error of every method on set work");
  auto arguments = std::make_shared<BenchArguments>();
  BenchOptions& options = arguments->options;
  command->add_option("--device", arguments->device, "Index or part of the name of an OpenCL device");
  command->add_option("--filter", options.filter, "Only benchmarks whose name matches this expression");
  command->add_option("--json", arguments->json, "Write the results as JSON");
  command->add_option("--size", arguments->size, "Pixels per side")->check(CLI::Range(16, 4096));
  command
      ->add_option("--repetitions", options.repetitions,
                   "Runs of each, of those that trace light a third; the median counts")
      ->check(CLI::Range(1, 100));
  command->add_flag("--peers", options.peers,
                    "Run vdb_render and Mitsuba on the same work too, where they are installed");
  command
      ->add_option("--compare", arguments->compare,
                   "Measure nothing: what changed from one --json to another by more than its noise")
      ->expected(2)
      ->type_name("BEFORE.json AFTER.json");
  command->callback([arguments, &run] {
    run = [arguments] { return arguments->compare.empty() ? bench_run(*arguments) : bench_compare(*arguments); };
  });
}

}  // namespace brume
