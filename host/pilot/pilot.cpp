// See pilot.hpp.
#include "pilot/pilot.hpp"

#include <algorithm>
#include <set>

#include "base/error.hpp"
#include "base/stopwatch.hpp"
#include "film/film_write.hpp"
#include "flat/media_methods.hpp"

namespace brume {

namespace {

constexpr int PANEL_PIXELS = 96, PANEL_LEAST = 24;
constexpr double PANEL_SECONDS = 0.3;
constexpr unsigned CHOOSING = 2, CHECKING = 3;  // seeds of panels; that of the picture's own witnesses is 1
constexpr int LIGHT_GRIDS[] = {16, 32, 64, 128};
constexpr int STEPS_BEYOND = 3;  // finer than half a cell, for light
constexpr double SURE = 0.5;     // an error this far below the goal needs no second panel
constexpr double RETRY = 0.7;    // of the goal, where the second panel has said no
constexpr double DEARER = 4;     // by cost: not worth a trial beside the quickest that is good enough

bool draws_numbers(int method) { return method_draws(method) != DRAWS_NOTHING; }

// Whether a step decides anything: the method has one, or a medium that takes another does.
bool has_steps(const SceneDesc& set) {
  const std::vector<MediumRow> media = media_rows(set);
  return std::any_of(media.begin(), media.end(),
                     [&](const MediumRow& m) { return method_has_step(method_resolve(set, *m.desc)); });
}

// A method from coarse to fine.
std::vector<Knobs> finenesses_of(const SceneDesc& desc, Knobs knobs, const KnobLimits& limits) {
  std::vector<Knobs> list;
  if (method_has_tolerance(knobs.method)) {
    for (const double tolerance : tolerances_all()) {
      knobs.tolerance = tolerance;
      list.push_back(knobs);
    }
    return list;
  }
  if (!has_steps(knobs_apply(desc, knobs))) return {knobs};
  for (const double step : steps_halving(limits, STEPS_BEYOND)) {
    knobs.step = step;
    list.push_back(knobs);
  }
  return list;
}

}  // namespace

Pilot::Pilot(ChartScene& scene, const std::vector<int>& methods) : scene_(scene), film_(scene.desc().film.size) {
  const SceneDesc& desc = scene.desc();
  for (const int method : methods) {
    if (draws_numbers(method) || method_row(method).share != 0.5f) continue;  // whose steps begin where they sample
    Knobs knobs{method, 0, 0, desc.render.storage, IN_SCATTERING_SEGMENT, desc.film.spp};
    if (scene.limits().grids && method != METHOD_HOMOGENEOUS)
      for (const int grid : LIGHT_GRIDS) {
        knobs.light_grid = grid;
        families_.push_back(finenesses_of(desc, knobs, scene.limits()));
      }
    knobs.light_grid = 0;
    families_.push_back(finenesses_of(desc, knobs, scene.limits()));
  }
  if (families_.empty())
    throw InputError(
        desc.file.string() +
        ": /render: for an error or a time a method is needed that draws no random numbers; allowed: auto, "
        "adaptive, march_midpoint, dda_midpoint, dda_gauss2, dda_nearest, homogeneous");
  std::stable_sort(families_.begin(), families_.end(),
                   [&](const auto& a, const auto& b) { return scene_.cost(a.front()) < scene_.cost(b.front()); });
  // A first look: which pixels are bright.
  SceneDesc look = knobs_apply(desc, families_.front().front());
  look.film.spp = 1;
  const Frame& frame = scene_.exact_scene(1).frame;
  scene_.render_pixels(look, film_, work_all(frame));
  preview_ = film_image(film_.cut({frame.crop_x0, frame.crop_y0}, {frame.crop_x1, frame.crop_y1}));
  panel_ = panel(CHOOSING, PANEL_SECONDS);
}

Pilot::Panel Pilot::panel(unsigned seed, double seconds) {
  const PlannedScene& exact = scene_.exact_scene(scene_.desc().film.spp);
  Panel made;
  made.truth =
      witnesses_ask(exact, witnesses_draw(preview_, exact.frame, PANEL_PIXELS, seed), {seconds, PANEL_LEAST, 3});
  double weights = 0;
  std::set<std::uint32_t> known;
  for (std::size_t i = 0; i < made.truth.draws.size(); ++i) {
    const WitnessDraw& draw = made.truth.draws[i];
    for (const double value : made.truth.radiance[i]) made.mean += draw.weight * std::abs(value) / 3;
    weights += draw.weight;
    const auto pixel = static_cast<std::uint32_t>(draw.y * film_.size().x + draw.x);
    if (known.insert(pixel).second) made.work.push_back({pixel, 0, static_cast<std::uint32_t>(scene_.desc().film.spp)});
  }
  made.mean /= weights;
  return made;
}

WitnessError Pilot::error_on(const Panel& panel, const Knobs& knobs, double* seconds) {
  for (const PixelWork& work : panel.work) film_.pixels()[work.pixel] = {};
  const ChartScene::PixelTimes times = scene_.render_pixels(knobs_apply(scene_.desc(), knobs), film_, panel.work);
  const Frame& frame = scene_.exact_scene(knobs.spp).frame;
  const double pixels = double(frame.crop_x1 - frame.crop_x0) * (frame.crop_y1 - frame.crop_y0);
  if (seconds) *seconds = times.once + times.pixels * pixels / double(panel.work.size());
  std::vector<std::array<double, 3>> shown;
  for (const WitnessDraw& draw : panel.truth.draws) {
    const FilmPixel& p = film_.pixels()[std::size_t(draw.y) * std::size_t(film_.size().x) + std::size_t(draw.x)];
    const double n = std::max(double(p.samples), 1.0);
    shown.push_back({p.radiance.x / n, p.radiance.y / n, p.radiance.z / n});
  }
  return witnesses_compare(panel.truth, shown, panel.mean);
}

const PilotTrial& Pilot::trial(const Knobs& knobs) {
  const auto [found, fresh] = trials_.emplace(knobs_id(knobs), PilotTrial{knobs, {}, 0});
  if (fresh) found->second.error = error_on(panel_, knobs, &found->second.seconds);
  return found->second;
}

// Finer steps of a family only take longer: the first that is good enough ends it, and so does one that takes longer
// than the best so far.
PilotChoice Pilot::quickest(const RenderDesc& goal) {
  const PilotTrial* best = nullptr;
  const PilotTrial* nearest = &trial(families_.front().front());
  for (const std::vector<Knobs>& family : families_) {
    if (best && scene_.cost(family.front()) > DEARER * scene_.cost(best->knobs)) continue;
    for (const Knobs& knobs : family) {
      const PilotTrial& it = trial(knobs);
      if (error_in(it.error, goal.error_metric) < error_in(nearest->error, goal.error_metric)) nearest = &it;
      if (best && it.seconds >= best->seconds) break;
      if (error_at_most(it.error, goal.error_metric) > *goal.max_error) continue;
      best = &it;
      break;
    }
  }
  return {best ? *best : *nearest, best != nullptr, 0, 0};
}

PilotChoice Pilot::closest(const RenderDesc& goal) {
  const PilotTrial* best = nullptr;
  const PilotTrial* first = &trial(families_.front().front());
  for (const std::vector<Knobs>& family : families_)
    for (const Knobs& knobs : family) {
      const PilotTrial& it = trial(knobs);
      if (it.seconds < first->seconds) first = &it;
      if (it.seconds > *goal.time_budget) break;
      if (!best || error_in(it.error, goal.error_metric) < error_in(best->error, goal.error_metric)) best = &it;
    }
  return {best ? *best : *first, best != nullptr, 0, 0};
}

PilotChoice Pilot::choose(const RenderDesc& goal) {
  const Stopwatch watch;
  PilotChoice choice = goal.max_error ? quickest(goal) : closest(goal);
  const auto sure = [&] { return error_at_most(choice.trial.error, goal.error_metric) <= SURE * *goal.max_error; };
  if (goal.max_error && choice.reached && !sure()) {
    const Panel second = panel(CHECKING, PANEL_SECONDS);
    RenderDesc tighter = goal;
    while (choice.reached &&
           error_in(error_on(second, choice.trial.knobs, nullptr), goal.error_metric) > *goal.max_error) {
      tighter.max_error = RETRY * *tighter.max_error;
      choice = quickest(tighter);
    }
  }
  choice.trials = static_cast<int>(trials_.size());
  choice.seconds = watch.seconds();
  return choice;
}

}  // namespace brume
