// See scene_bench.hpp.
#include "scene_bench.hpp"

#include <map>

#include "base/interrupt.hpp"
#include "base/stopwatch.hpp"
#include "film/film_compare.hpp"
#include "film/film_write.hpp"
#include "plan/planned_scene.hpp"
#include "render/renderer.hpp"
#include "scene/scene_reader.hpp"

namespace brume::bench {

namespace {

struct SceneRow {
  const char *name, *file, *override;
};
constexpr SceneRow SCENES[] = {{"dam_break_local", "dam_break_local", ""},
                               {"dam_break_local/water_alone", "dam_break_local", "/shapes=[]"},
                               {"dam_break", "dam_break", ""},
                               {"instances", "instances", ""},
                               {"whitted", "whitted", ""}};
constexpr double FINER = 16;  // steps of the picture that the error is against; surfaces have none, nor an error

Film rendered(Renderer& renderer, glm::ivec2 size) {
  Film film(size);
  if (!renderer.render(film, [](double) { return !interrupt_requested(); })) interrupt_check();
  return film;
}

// Rendered once for all runs.
const Image& converged(Context& context, const std::string& name, SceneDesc desc, int lanes) {
  static std::map<std::string, Image> known;
  const auto found = known.find(name);
  if (found != known.end()) return found->second;
  desc.render.step /= FINER;
  const PlannedScene scene = flatten(desc, {bvh_width_for(lanes), {}});
  Renderer renderer(context, scene, {lanes, false, 0});
  return known[name] = film_image(rendered(renderer, desc.film.size));
}

}  // namespace

std::vector<SceneCase> scene_cases() {
  std::vector<SceneCase> cases;
  for (const SceneRow& row : SCENES) {
    const std::filesystem::path file = std::filesystem::path("scenes") / (std::string(row.file) + ".json");
    const std::string change = row.override;
    if (!std::filesystem::exists(file)) continue;
    cases.push_back({row.name, file, change.empty() ? std::vector<std::string>{} : std::vector{change}});
  }
  return cases;
}

void scene_benchmark(::benchmark::State& state, const DeviceInfo& device, const SceneCase& scene, glm::ivec2 size) {
  Context context(device);
  const int lanes = lanes_choose(context.device(), 0);
  SceneDesc desc = scene_read(scene.file, scene.overrides);
  desc.film.size = size;
  const PlannedScene planned = flatten(desc, {bvh_width_for(lanes), {}});
  Film film({0, 0});
  for (auto unused : state) {
    (void)unused;
    Renderer renderer(context, planned, {lanes, false, 0});
    const Stopwatch watch;
    film = rendered(renderer, size);
    state.SetIterationTime(watch.seconds());
    state.counters["lookups"] = renderer.stats().lookups;
  }
  const CompareResult error = image_compare(film_image(film), converged(context, scene.name, desc, lanes));
  state.counters["rel_rmse"] = error.rel_rmse;
  state.counters["display_p99"] = error.display_p99;
}

}  // namespace brume::bench
