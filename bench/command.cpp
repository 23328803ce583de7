// brume bench: throughput and accuracy on Google Benchmark; times are those of whole renders without kernel builds.
#include <benchmark/benchmark.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>

#include "base/error.hpp"
#include "base/interrupt.hpp"
#include "base/stopwatch.hpp"
#include "cli/command.hpp"
#include "film/film_compare.hpp"
#include "film/film_write.hpp"
#include "measure.hpp"
#include "peers.hpp"
#include "render/device_scene.hpp"

namespace brume {

namespace {

using namespace bench;

struct BenchArguments {
  std::string device, filter = ".", json;
  int size = 512, repetitions = 3;
  bool peers = false;
};

// A folder for volumes and pictures, gone at the end.
class Scratch {
 public:
  Scratch() {
    std::string name = (std::filesystem::temp_directory_path() / "brume_bench_XXXXXX").string();
    if (!mkdtemp(name.data())) throw RuntimeError(name + ": cannot be created");
    path_ = name;
    interrupt_removes(path_);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

void render_benchmark(::benchmark::State& state, const DeviceInfo& device, const Workload& work,
                      const Setting& setting) {
  Context context(device);  // counts the memory of this render alone
  const int lanes = lanes_choose(context.device(), 0);
  const FlatScene& flat = flat_scene(work, setting, lanes);
  Renderer renderer(context, std::make_shared<DeviceScene>(context, flat), plan_of(work, setting, flat),
                    {lanes, false, 0});
  Film film({0, 0});
  for (auto unused : state) {
    (void)unused;
    const Stopwatch watch;
    film = Film(work.desc.film.size);
    if (!renderer.render(film, [](double) { return !interrupt_requested(); })) interrupt_check();
    state.SetIterationTime(watch.seconds());
  }
  const CompareResult error = image_compare(film_image(film), exact_picture(context, work));
  state.counters["rel_rmse"] = error.rel_rmse;
  state.counters["device_MB"] = static_cast<double>(renderer.stats().device_bytes) / 1e6;
  state.counters["lookups"] = renderer.stats().lookups;
}

void peer_benchmark(::benchmark::State& state, const Workload& work, const std::filesystem::path& folder) {
  std::optional<PeerRun> run;
  for (auto unused : state) {
    (void)unused;
    run = vdb_render_run(work, folder, false);
    if (!run) return state.SkipWithError("vdb_render did not run");
    state.SetIterationTime(run->render_s);
  }
  static std::map<std::string, std::optional<PeerRun>> known;  // takes minutes, serves all repetitions
  if (!known.count(work.name)) known[work.name] = vdb_render_run(work, folder, true);
  const std::optional<PeerRun>& converged = known[work.name];
  if (!converged) return state.SkipWithError("vdb_render did not run");
  state.counters["rel_rmse"] = image_compare(image_read(run->picture), image_read(converged->picture)).rel_rmse;
  state.counters["process_s"] = run->process_s;
}

void mitsuba_benchmark(::benchmark::State& state, const DeviceInfo& device, const Workload& work,
                       const std::filesystem::path& folder) {
  std::optional<MitsubaRun> run;
  for (auto unused : state) {
    (void)unused;
    run = mitsuba_run(work, folder);
    if (!run) return state.SkipWithError("no Mitsuba here (BRUME_PYTHON names a Python that has it)");
    state.SetIterationTime(run->render_s);
  }
  const Image one = image_read(run->pictures[0]), two = image_read(run->pictures[1]);
  state.counters["rel_rmse"] = image_compare(one, two).rel_rmse / std::sqrt(2.0);  // two errors of the same size
  Context context(device);
  const Image& exact = exact_picture(context, work);
  double theirs = 0, ours = 0;
  for (std::size_t i = 0; i < exact.values.size(); ++i) {
    theirs += 0.5 * (double(one.values[i]) + two.values[i]);
    ours += exact.values[i];
  }
  state.counters["mean_to_exact"] = theirs / ours;
}

void process_benchmark(::benchmark::State& state, const SceneDesc& desc, const std::filesystem::path& folder) {
  brume_process_seconds(desc, folder);  // fills the kernel cache
  for (auto unused : state) {
    (void)unused;
    const std::optional<double> seconds = brume_process_seconds(desc, folder);
    if (!seconds) return state.SkipWithError("brume did not run");
    state.SetIterationTime(*seconds);
  }
}

const Setting& setting_of(const std::string& name) {
  for (const Setting& s : settings())
    if (s.name == name) return s;
  throw RuntimeError("no setting " + name);
}

void register_all(const DeviceInfo& device, const std::vector<Workload>& all, const BenchArguments& arguments,
                  const std::filesystem::path& folder) {
  const auto manual = [&](::benchmark::internal::Benchmark* b, bool slow = false) {
    b->UseManualTime()->Unit(::benchmark::kMillisecond)->Iterations(1);
    b->Repetitions(slow ? 1 : arguments.repetitions);
    if (!slow) b->ReportAggregatesOnly(true);
  };
  for (const Workload& work : all) {
    if (arguments.peers)
      manual(::benchmark::RegisterBenchmark(
          ("peer/" + work.name + "/vdb_render").c_str(),
          [&work, folder](::benchmark::State& state) { peer_benchmark(state, work, folder); }));
    if (arguments.peers)
      manual(::benchmark::RegisterBenchmark(("peer/" + work.name + "/mitsuba_64spp").c_str(),
                                            [&device, &work, folder](::benchmark::State& state) {
                                              mitsuba_benchmark(state, device, work, folder);
                                            }),
             true);
    for (const char* name : {"march_midpoint_2/grid64", "march_midpoint_4/grid32", "march_midpoint_6/grid24"})
      manual(::benchmark::RegisterBenchmark(("process/" + work.name + "/" + name).c_str(),
                                            [&work, name, folder](::benchmark::State& state) {
                                              process_benchmark(state, scene_of(work, setting_of(name)), folder);
                                            }));
    for (const Setting& setting : settings())
      manual(::benchmark::RegisterBenchmark(("render/" + work.name + "/" + setting.name).c_str(),
                                            [&device, &work, &setting](::benchmark::State& state) {
                                              render_benchmark(state, device, work, setting);
                                            }),
             setting.shadow == SHADOW_TRACE);  // seconds to minutes each
  }
}

int bench_run(const BenchArguments& arguments) {
  const Scratch scratch;
  const std::vector<Workload> all = workloads(scratch.path(), arguments.size);
  const DeviceInfo device = device_choose(arguments.device);
  std::vector<std::string> words{"brume bench", "--benchmark_filter=" + arguments.filter,
                                 "--benchmark_counters_tabular=true"};
  if (!arguments.json.empty()) {
    words.push_back("--benchmark_out=" + arguments.json);
    words.push_back("--benchmark_out_format=json");
  }
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  int count = static_cast<int>(pointers.size());
  ::benchmark::Initialize(&count, pointers.data());
  ::benchmark::AddCustomContext("device", device.title());
  register_all(device, all, arguments, scratch.path());
  if (::benchmark::RunSpecifiedBenchmarks() == 0)
    throw InputError("--filter: no benchmark matches '" + arguments.filter + "'");
  return 0;
}

}  // namespace

void command_bench(CLI::App& app, Command& run) {
  CLI::App* command = app.add_subcommand("bench", "Measure time and error of every method on set work");
  auto arguments = std::make_shared<BenchArguments>();
  command->add_option("--device", arguments->device, "Index or part of the name of an OpenCL device");
  command->add_option("--filter", arguments->filter, "Only benchmarks whose name matches this expression");
  command->add_option("--json", arguments->json, "Write the results as JSON");
  command->add_option("--size", arguments->size, "Pixels per side")->check(CLI::Range(16, 4096));
  command->add_option("--repetitions", arguments->repetitions, "Runs of each; the median counts")
      ->check(CLI::Range(1, 100));
  command->add_flag("--peers", arguments->peers,
                    "Run vdb_render and Mitsuba on the same work too, where they are installed");
  command->callback([arguments, &run] { run = [arguments] { return bench_run(*arguments); }; });
}

}  // namespace brume
