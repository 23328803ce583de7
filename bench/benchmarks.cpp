// See benchmarks.hpp.
#include "benchmarks.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <sstream>

#include "absorb_bench.hpp"
#include "base/error.hpp"
#include "base/interrupt.hpp"
#include "base/stopwatch.hpp"
#include "film/film_compare.hpp"
#include "film/film_write.hpp"
#include "measure.hpp"
#include "peers.hpp"
#include "ray_bench.hpp"
#include "render/device_scene.hpp"
#include "scene_bench.hpp"

namespace brume::bench {

namespace {

constexpr int QUICK_RUNS = 5;  // of what takes milliseconds, for each of other benchmarks

void render_benchmark(::benchmark::State& state, const DeviceInfo& device, const Workload& work,
                      const Setting& setting) {
  Context context(device);  // counts the memory of this render alone
  const int lanes = lanes_choose(context.device(), 0);
  const FlatScene& flat = flat_scene(work, setting, lanes);
  const auto scene = std::make_shared<DeviceScene>(context, flat);
  const RenderPlan plan = plan_of(work, setting, flat);
  Film film({0, 0});
  for (auto unused : state) {
    (void)unused;
    Renderer renderer(context, scene, plan, {lanes, false, 0});  // one that has rendered has its light grids already
    const Stopwatch watch;
    film = Film(work.desc.film.size);
    if (!renderer.render(film, [](double) { return !interrupt_requested(); })) interrupt_check();
    state.SetIterationTime(watch.seconds());
    state.counters["device_bytes"] = static_cast<double>(renderer.stats().device_bytes);
    state.counters["lookups"] = renderer.stats().lookups;
  }
  const CompareResult error = image_compare(film_image(film), exact_picture(context, work));
  state.counters["rel_rmse"] = error.rel_rmse;
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

// Its runs by name instead of one row for each and four for what they have in common.
class RowReporter : public ::benchmark::BenchmarkReporter {
 public:
  RowReporter(const std::function<void()>& begin, const std::function<void(const Row&)>& report)
      : begin_(begin), report_(report) {}

  bool ReportContext(const Context&) override {
    begin_();
    return true;
  }

  void ReportRuns(const std::vector<Run>& runs) override {
    Row row;
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration) continue;
      row.name = run.run_name.function_name;  // without "/iterations:1/repeats:3/manual_time"
      if (run.error_occurred)
        row.failure = run.error_message;
      else
        row.seconds.push_back(run.real_accumulated_time / static_cast<double>(run.iterations));
      for (const auto& [key, counter] : run.counters) row.counters[key] = counter.value;
    }
    if (row.name.empty()) return;  // what they have in common comes by itself
    rows_.push_back(row);
    report_(row);
  }

  const std::vector<Row>& rows() const { return rows_; }

 private:
  const std::function<void()>& begin_;
  const std::function<void(const Row&)>& report_;
  std::vector<Row> rows_;
};

using Measure = std::function<void(::benchmark::State&)>;

void add(const std::string& name, int repetitions, const Measure& measure) {
  ::benchmark::RegisterBenchmark(name.c_str(), measure)
      ->UseManualTime()
      ->Unit(::benchmark::kSecond)
      ->Iterations(1)
      ->Repetitions(repetitions);
}

void add_all(const DeviceInfo& device, const Workload& work, const BenchOptions& options,
             const std::filesystem::path& folder) {
  const int runs = options.repetitions, slow = std::max(runs / 3, 1);
  if (options.peers) {
    add("peer/" + work.name + "/vdb_render", runs,
        [&work, folder](::benchmark::State& state) { peer_benchmark(state, work, folder); });
    add("peer/" + work.name + "/mitsuba_64spp", slow,
        [&device, &work, folder](::benchmark::State& state) { mitsuba_benchmark(state, device, work, folder); });
  }
  for (const char* name : {"march_midpoint_2/grid64", "march_midpoint_4/grid32", "march_midpoint_6/grid24"})
    add("process/" + work.name + "/" + name, runs, [&work, name, folder](::benchmark::State& state) {
      process_benchmark(state, scene_of(work, setting_of(name)), folder);
    });
  for (const Setting& setting : settings())
    add("render/" + work.name + "/" + setting.name, setting.shadow == SHADOW_TRACE ? slow : runs,
        [&device, &work, &setting](::benchmark::State& state) { render_benchmark(state, device, work, setting); });
}

}  // namespace

std::vector<Row> benchmarks_run(const DeviceInfo& device, const std::vector<Workload>& workloads,
                                const BenchOptions& options, const std::filesystem::path& folder,
                                const std::function<void()>& begin, const std::function<void(const Row&)>& report) {
  std::string words[] = {"brume bench", "--benchmark_filter=" + options.filter};
  char* pointers[] = {words[0].data(), words[1].data(), nullptr};
  int count = 2;
  ::benchmark::Initialize(&count, pointers);
  for (const Workload& work : workloads) add_all(device, work, options, folder);
  const std::vector<SceneCase> scenes = scene_cases();
  for (const SceneCase& scene : scenes)
    add("scene/" + scene.name, options.repetitions,
        [&](::benchmark::State& state) { scene_benchmark(state, device, scene, workloads.front().desc.film.size); });
  const int quick_runs = QUICK_RUNS * options.repetitions;
  for (const Workload& work : workloads)
    for (const Bench& bench : absorb_benches(device, work, folder, quick_runs, options.peers))
      add(bench.name, quick_runs, bench.measure);
  for (const Bench& bench : ray_benches(device, folder, quick_runs, options.peers))
    add(bench.name, quick_runs, bench.measure);
  RowReporter reporter(begin, report);
  std::ostringstream complaints;  // of a filter that is none, or that nothing matches
  reporter.SetErrorStream(&complaints);
  if (::benchmark::RunSpecifiedBenchmarks(&reporter) == 0)
    throw InputError("--filter: no benchmark matches '" + options.filter + "'");
  return reporter.rows();
}

}  // namespace brume::bench
