// See pilot.hpp.
#include "pilot/pilot.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "base/error.hpp"
#include "pilot/looks.hpp"

namespace brume {

namespace {

constexpr int PANEL_PIXELS = 96, PANEL_LEAST = 24;
constexpr double PANEL_SHARE = 0.2;  // of the time of the coarsest picture
constexpr double PANEL_SECONDS_LEAST = 0.08, PANEL_SECONDS_MOST = 0.5;
constexpr unsigned CHOOSING = 2, CHECKING = 3;  // seeds of pixels; the picture's own witnesses have 1
constexpr double SURE = 0.5;                    // an error this far below the goal needs no second panel
constexpr double LIKELY = 1.7;      // times its error on the panel is below the goal: taken where none is surely below
constexpr double RETRY = 0.7;       // of the goal, where the second panel has said no
constexpr double DEARER = 8;        // by cost: not worth a trial beside the quickest that is good enough
constexpr double STALLED = 0.85;    // of the error before: what halving a step leaves where it no longer matters
constexpr double MORE = 1.2;        // times the lookups: really finer
constexpr double GRID_GAIN = 4;     // by which the error of a light grid falls at most with cells half as long,
constexpr double GRID_COST = 8;     // and how much longer that takes to fill: by their number
constexpr double GRID_FROM = 0.05;  // s: less than the kernels of a first light grid take to load
constexpr double EQUAL = 1.2;       // errors of which the quicker is taken where none is good enough
constexpr double TIMED = 2;         // times the quickest: near enough to be timed against it
constexpr std::size_t TIMED_MOST = 4;
constexpr double TIMED_FROM = 0.1;  // s: quicker pictures are not worth it

// What a pixel costs, in density lookups: for its samples and shadow rays in themselves, too. Counts tell candidates
// apart where a few pixels are over too soon to be timed.
double effort_of(const FilmPixel& p) { return p.lookups + 4.0 * p.shadow_rays + 100.0 * p.samples; }

}  // namespace

Pilot::Pilot(ChartScene& scene, const std::vector<int>& methods)
    : scene_(scene), families_(knob_families(scene, methods)), film_(scene.desc().film.size) {
  const SceneDesc& desc = scene.desc();
  if (families_.empty())
    throw InputError(
        desc.file.string() +
        ": /render: for an error or a time a method is needed that draws no random numbers; allowed: auto, "
        "adaptive, march_midpoint, dda_midpoint, dda_gauss2, dda_nearest, homogeneous");
  // A first look: which pixels are bright, and what there is to gain.
  SceneDesc look = knobs_apply(desc, families_.front().front());
  look.film.spp = 1;
  const Frame& frame = scene_.exact_scene(1).frame;
  const WorkList all = work_all(frame);
  spread_ = work_spread(all);
  for (PixelWork& work : spread_) work.samples = static_cast<std::uint32_t>(desc.film.spp);
  pixels_ = double(all.size());
  const Look first(frame);
  const WorkList looked = first.work(all, film_.size().x);
  const ChartScene::PixelTimes times = scene_.render_pixels(look, film_, looked);
  least_seconds_ = times.once + times.pixels * desc.film.spp * pixels_ / double(looked.size());
  double effort = 0;
  for (const PixelWork& work : looked) effort += effort_of(film_.pixels()[work.pixel]);
  effort_seconds_ = times.pixels / effort;
  preview_ = first.picture(film_);
  panel_ = panel(CHOOSING);
}

Pilot::Panel Pilot::panel(unsigned seed) {
  const PlannedScene& exact = scene_.exact_scene(scene_.desc().film.spp);
  const double seconds = std::clamp(PANEL_SHARE * least_seconds_, PANEL_SECONDS_LEAST, PANEL_SECONDS_MOST);
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

// Of the whole picture, by the effort of a panel's pixels and how many each stands for.
double Pilot::seconds_of(const ChartScene::PixelTimes& times, const Panel& panel) const {
  double effort = 0, weights = 0;
  for (const WitnessDraw& draw : panel.truth.draws) {
    effort += draw.weight * effort_of(film_.pixels()[std::size_t(draw.y) * std::size_t(film_.size().x) + draw.x]);
    weights += draw.weight;
  }
  return times.once + effort_seconds_ * pixels_ * effort / weights;
}

WitnessError Pilot::error_on(const Panel& panel, const Knobs& knobs, PilotTrial* its) {
  for (const PixelWork& work : panel.work) film_.pixels()[work.pixel] = {};
  const ChartScene::PixelTimes times = scene_.render_pixels(knobs_apply(scene_.desc(), knobs), film_, panel.work);
  if (its) {
    its->once = times.once;
    its->lookups = 0;
    for (const PixelWork& work : panel.work) its->lookups += film_.pixels()[work.pixel].lookups;
    its->seconds = seconds_of(times, panel);
  }
  std::vector<std::array<double, 3>> shown;
  for (const WitnessDraw& draw : panel.truth.draws)
    shown.push_back(shown_by(film_.pixels()[std::size_t(draw.y) * std::size_t(film_.size().x) + std::size_t(draw.x)]));
  return witnesses_compare(panel.truth, shown, panel.mean);
}

PilotTrial& Pilot::trial(const Knobs& knobs) {
  const auto [found, fresh] = trials_.emplace(knobs_id(knobs), PilotTrial{knobs, {}, 0, 0, 0, false});
  if (fresh) found->second.error = error_on(panel_, knobs, &found->second);
  return found->second;
}

bool Pilot::good_enough(const PilotTrial& trial, const RenderDesc& goal) const {
  return (likely_ ? LIKELY * error_in(trial.error, goal.error_metric)
                  : error_at_most(trial.error, goal.error_metric)) <= *goal.max_error;
}

// The first of a family that is good enough. The rest is left out once finer steps, more of them, have changed nothing
// twice in a row, because the error is that of the rule.
PilotTrial* Pilot::coarsest(const KnobFamily& family, const RenderDesc& goal) {
  double error = INFINITY, lookups = 0;
  int stalls = 0;
  for (const Knobs& knobs : family) {
    PilotTrial& it = trial(knobs);
    if (good_enough(it, goal)) return &it;
    if (it.lookups < MORE * lookups) continue;
    const double now = error_in(it.error, goal.error_metric);
    const bool stalled = now > STALLED * error && now < error / STALLED;  // one that grows is no end yet
    stalls = stalled ? stalls + 1 : 0;
    if (stalls == 2) return nullptr;
    error = now;
    lookups = it.lookups;
  }
  return nullptr;
}

// As it was, or by the number of cells from the finest that was filled; 0 before any was.
double Pilot::fill_seconds(int grid) const {
  const auto after = fill_seconds_.upper_bound(grid);
  if (after == fill_seconds_.begin()) return 0;
  const auto [filled, seconds] = *std::prev(after);
  return seconds * std::pow(double(grid) / filled, std::log2(GRID_COST));
}

// The first light grid that is good enough in place of tracing with settings that are, and may be quicker than
// `seconds`. One that was too coarse once is so for every method.
PilotTrial* Pilot::coarsest_grid(const KnobFamily& family, Knobs knobs, const RenderDesc& goal, double seconds) {
  if (seconds < GRID_FROM) return nullptr;
  double hoped = 0;  // the least that the error of the next may be
  for (const int grid : family_grids(family, scene_)) {
    hoped /= GRID_GAIN;
    if (grid <= too_coarse_ || hoped > *goal.max_error) continue;
    if (least_seconds_ + fill_seconds(grid) > seconds) return nullptr;
    knobs.light_grid = grid;
    PilotTrial& it = trial(knobs);
    fill_seconds_[grid] = it.once;
    if (good_enough(it, goal)) return &it;
    too_coarse_ = grid;
    if (it.seconds + (GRID_COST - 1) * it.once > seconds) return nullptr;
    hoped = error_in(it.error, goal.error_metric);
  }
  return nullptr;
}

// By pixels from all over the picture.
void Pilot::time(PilotTrial& trial) {
  for (const PixelWork& work : spread_) film_.pixels()[work.pixel] = {};
  const ChartScene::PixelTimes times = scene_.render_pixels(knobs_apply(scene_.desc(), trial.knobs), film_, spread_);
  trial.seconds = times.once + times.pixels * pixels_ / double(spread_.size());
  trial.timed = true;
}

// Those that should be about as quick as the quickest are timed against it.
PilotTrial& Pilot::quickest_of(std::vector<PilotTrial*> good) {
  const auto quicker = [](const PilotTrial* a, const PilotTrial* b) { return a->seconds < b->seconds; };
  std::sort(good.begin(), good.end(), quicker);
  const double limit = TIMED * good.front()->seconds;
  while (good.size() > TIMED_MOST || good.back()->seconds > limit) good.pop_back();
  if (good.size() == 1 || good.front()->seconds < TIMED_FROM) return *good.front();
  for (PilotTrial* it : good) time(*it);
  return **std::min_element(good.begin(), good.end(), quicker);
}

// Of all trials the closest, or one hardly further off that is quicker.
PilotTrial& Pilot::nearest(int metric) {
  double least = INFINITY;
  for (const auto& [id, it] : trials_) least = std::min(least, error_in(it.error, metric));
  const auto good = [&](const PilotTrial& it) { return error_in(it.error, metric) <= EQUAL * least; };
  return std::min_element(trials_.begin(), trials_.end(),
                          [&](const auto& a, const auto& b) {
                            if (good(a.second) != good(b.second)) return good(a.second);
                            return a.second.seconds < b.second.seconds;
                          })
      ->second;
}

PilotChoice Pilot::quickest(const RenderDesc& goal) {
  std::vector<PilotTrial*> good;
  const PilotTrial* best = nullptr;
  too_coarse_ = 0;
  const auto add = [&](PilotTrial* it) {
    if (!it) return;
    good.push_back(it);
    if (!best || it->seconds < best->seconds) best = it;
  };
  for (const KnobFamily& family : families_) {
    if (best && scene_.cost(family.front()) > DEARER * scene_.cost(best->knobs)) continue;
    PilotTrial* traced = coarsest(family, goal);
    add(traced);
    if (traced) add(coarsest_grid(family, traced->knobs, goal, best->seconds));
  }
  if (best) return {quickest_of(good), true, 0, 0};
  if (likely_) return {nearest(goal.error_metric), false, 0, 0};
  likely_ = true;
  return quickest(goal);
}

PilotChoice Pilot::choose(const RenderDesc& goal) {
  PilotChoice choice = goal.max_error ? quickest(goal) : closest(goal);
  const auto sure = [&] { return error_at_most(choice.trial.error, goal.error_metric) <= SURE * *goal.max_error; };
  if (goal.max_error && choice.reached && !sure()) {
    const Panel second = panel(CHECKING);
    RenderDesc tighter = goal;
    while (choice.reached &&
           error_in(error_on(second, choice.trial.knobs, nullptr), goal.error_metric) > *goal.max_error) {
      tighter.max_error = RETRY * *tighter.max_error;
      choice = quickest(tighter);
    }
  }
  choice.trials = static_cast<int>(trials_.size());
  choice.seconds = watch_.seconds();
  return choice;
}

}  // namespace brume
