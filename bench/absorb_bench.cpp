// See absorb_bench.hpp.
#include "absorb_bench.hpp"

#include "base/interrupt.hpp"
#include "base/stopwatch.hpp"
#include "film/film_compare.hpp"
#include "film/film_write.hpp"
#include "measure.hpp"
#include "peers.hpp"
#include "render/device_scene.hpp"

namespace brume::bench {

namespace {

constexpr Setting METHODS[] = {{"dda_gauss2", METHOD_DDA_GAUSS2, 0, SHADOW_TRACE},
                               {"dda_midpoint", METHOD_DDA_MIDPOINT, 0, SHADOW_TRACE},
                               {"march_midpoint_1", METHOD_MARCH_MIDPOINT, 1, SHADOW_TRACE}};

// The same volume, as dense.
Workload absorbing(const Workload& work) {
  Workload absorbs = work;
  absorbs.name += "_absorbing";
  MediumDesc& medium = absorbs.desc.media[0];
  medium.sigma_a += medium.sigma_s;
  medium.sigma_s = dvec3(0);
  absorbs.desc.lights.clear();
  absorbs.desc.background = dvec3(1);
  return absorbs;
}

double error_of(const DeviceInfo& device, const Workload& work, const Image& picture) {
  Context context(device);
  return image_compare(picture, exact_picture(context, work)).rel_rmse;
}

std::vector<double> brume_seconds(const DeviceInfo& device, const Workload& work, const Setting& setting, int runs,
                                  Counters& counters) {
  Context context(device);
  const int lanes = lanes_choose(context.device(), 0);
  const FlatScene& flat = flat_scene(work, setting, lanes);
  Renderer renderer(context, std::make_shared<DeviceScene>(context, flat), plan_of(work, setting, flat),
                    {lanes, false, 0});
  Film film({0, 0});
  std::vector<double> seconds;
  for (int run = -1; run < runs; ++run) {  // one that warms up
    film = Film(work.desc.film.size);
    const Stopwatch watch;
    if (!renderer.render(film, [](double) { return !interrupt_requested(); })) interrupt_check();
    if (run >= 0) seconds.push_back(watch.seconds());
  }
  counters["lookups"] = renderer.stats().lookups;
  counters["rel_rmse"] = error_of(device, work, film_image(film));
  return seconds;
}

std::vector<double> vtk_seconds(const DeviceInfo& device, const Workload& work, int runs,
                                const std::filesystem::path& folder, Counters& counters) {
  const std::optional<VtkRun> run = vtk_run(work, device.compute_units, runs, folder);
  if (!run) return {};
  counters["rel_rmse"] = error_of(device, work, run->transmittance);
  return run->seconds;
}

}  // namespace

std::vector<Bench> absorb_benches(const DeviceInfo& device, const Workload& work, const std::filesystem::path& folder,
                                  int repetitions, bool peers) {
  const auto absorbs = std::make_shared<Workload>(absorbing(work));
  std::vector<Bench> benches;
  for (const Setting& setting : METHODS)
    benches.push_back(
        bench_of("absorb/" + work.name + "/" + setting.name, "", [=, &device, &setting](Counters& counters) {
          return brume_seconds(device, *absorbs, setting, repetitions, counters);
        }));
  if (peers)
    benches.push_back(bench_of(
        "peer/" + work.name + "/vtk", "no VTK here (BRUME_PYTHON names a Python that has it)",
        [=, &device](Counters& counters) { return vtk_seconds(device, *absorbs, repetitions, folder, counters); }));
  return benches;
}

}  // namespace brume::bench
