// For a time: which candidate comes closest within it. See pilot.hpp.
#include <algorithm>
#include <cmath>

#include "pilot/pilot.hpp"

namespace brume {

namespace {

constexpr double SEARCH_SHARE = 0.5, SEARCH_LEAST = 0.3;  // of a time budget, and s: what looking for the closest takes
constexpr double FAR_WITHIN = 3;                          // times quicker than the budget: finer ones may be, too
constexpr double FAR_BEYOND = 8;                          // times it, by cost: not worth a trial

}  // namespace

bool Pilot::search_goes_on(const RenderDesc& goal) const {
  return watch_.seconds() < std::max(SEARCH_LEAST, SEARCH_SHARE * *goal.time_budget);
}

// The finest of a family that should keep to the time: first the one that does by its cost, then its neighbours, as far
// off as steps that halve would be.
void Pilot::finest_within(const KnobFamily& family, int grid, const RenderDesc& goal) {
  const double budget = *goal.time_budget, seconds_of_cost = least_seconds_ / scene_.cost(families_.front().front());
  const auto member = [&](int i) {
    Knobs knobs = family[std::size_t(i)];
    knobs.light_grid = grid;
    return knobs;
  };
  const bool some_keeps_to_it =
      std::any_of(trials_.begin(), trials_.end(), [&](const auto& t) { return t.second.seconds <= budget; });
  if ((some_keeps_to_it || family.size() == 1) && seconds_of_cost * scene_.cost(member(0)) > FAR_BEYOND * budget)
    return;
  int within = -1, beyond = int(family.size()), at = 0;
  while (at + 1 < beyond && seconds_of_cost * scene_.cost(member(at + 1)) <= budget) ++at;
  while (within < at && at < beyond && search_goes_on(goal)) {
    PilotTrial& it = trial(member(at));
    if (!it.timed && it.seconds < FAR_BEYOND * budget) time(it);
    if (it.seconds > budget) {
      beyond = at;
      at = std::max(at - std::max(1, int(std::log2(it.seconds / budget))), within + 1);
    } else {
      within = at;
      if (FAR_WITHIN * it.seconds < budget) ++at;
    }
  }
}

// Candidates that should keep to the time: those with nothing to turn first, which are exact, then those that adapt.
void Pilot::try_within(const RenderDesc& goal) {
  Knobs quickest = families_.front().front();
  trial(quickest);
  std::vector<int> grids = family_grids(families_.front(), scene_);
  if (!grids.empty()) {
    quickest.light_grid = grids.front();
    trial(quickest);
  }
  std::vector<const KnobFamily*> order;
  for (const KnobFamily& family : families_) order.push_back(&family);
  const auto rank = [](const KnobFamily* f) {
    return f->size() == 1 ? 0 : method_has_tolerance(f->front().method) ? 1 : 2;
  };
  std::stable_sort(order.begin(), order.end(), [&](const auto* a, const auto* b) { return rank(a) < rank(b); });
  for (const KnobFamily* family : order) finest_within(*family, 0, goal);
  for (const KnobFamily* family : order)
    for (const int grid : family_grids(*family, scene_)) finest_within(*family, grid, goal);
}

PilotChoice Pilot::closest(const RenderDesc& goal) {
  try_within(goal);
  std::vector<PilotTrial*> trials;
  for (auto& [id, it] : trials_) trials.push_back(&it);
  std::sort(trials.begin(), trials.end(), [&](const PilotTrial* a, const PilotTrial* b) {
    return error_in(a->error, goal.error_metric) < error_in(b->error, goal.error_metric);
  });
  for (PilotTrial* it : trials) {
    if (it->seconds > *goal.time_budget) continue;
    if (!it->timed) time(*it);
    if (it->seconds <= *goal.time_budget) return {*it, true, 0, 0};
  }
  const auto first = std::min_element(trials.begin(), trials.end(),
                                      [](const auto* a, const auto* b) { return a->seconds < b->seconds; });
  if (!(*first)->timed) time(**first);
  return {**first, (*first)->seconds <= *goal.time_budget, 0, 0};
}

}  // namespace brume
