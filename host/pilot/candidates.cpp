// See candidates.hpp.
#include "pilot/candidates.hpp"

#include <algorithm>

#include "flat/media_methods.hpp"

namespace brume {

namespace {

constexpr int STEPS_BEYOND = 3;  // finer than half a cell, for light
constexpr int LEVEL_CELLS = 64;  // with fewer along a side a volume takes no time that averaging would save
constexpr int RULES[] = {IN_SCATTERING_SEGMENT, IN_SCATTERING_GAUSS2};

// Whether a step decides anything: the method has one, or a medium that takes another does.
bool has_steps(const SceneDesc& set) {
  const std::vector<MediumRow> media = media_rows(set);
  return std::any_of(media.begin(), media.end(),
                     [&](const MediumRow& m) { return method_has_step(method_resolve(set, *m.desc)); });
}

KnobFamily family_of(const ChartScene& scene, Knobs knobs) {
  if (method_has_tolerance(knobs.method)) {
    KnobFamily family;
    for (const double tolerance : tolerances_all()) {
      knobs.tolerance = tolerance;
      family.push_back(knobs);
    }
    return family;
  }
  if (!has_steps(knobs_apply(scene.desc(), knobs))) return {knobs};
  KnobFamily family;
  for (const double step : steps_halving(limits_at(scene.limits(), knobs.level), STEPS_BEYOND)) {
    knobs.step = step;
    family.push_back(knobs);
  }
  return family;
}

}  // namespace

std::vector<KnobFamily> knob_families(ChartScene& scene, const std::vector<int>& methods) {
  const SceneDesc& desc = scene.desc();
  std::vector<KnobFamily> families;
  for (const int method : methods) {
    const MethodRow row = method_row(method);
    if (row.draws != DRAWS_NOTHING || row.share != 0.5f) continue;  // whose steps begin where they sample
    for (const int rule : RULES) {
      if (method_has_tolerance(method) && rule != IN_SCATTERING_SEGMENT) continue;  // it has its own
      families.push_back(family_of(scene, {method, 0, 0, desc.render.storage, rule, desc.film.spp}));
    }
    if (row.rule == RULE_PRODUCT) continue;
    for (const int level : LEVELS)
      if (limits_at(scene.limits(), level).cells >= LEVEL_CELLS)
        families.push_back(
            family_of(scene, {method, 0, 0, desc.render.storage, IN_SCATTERING_SEGMENT, desc.film.spp, 0, level}));
  }
  std::stable_sort(families.begin(), families.end(), [&](const KnobFamily& a, const KnobFamily& b) {
    return scene.cost(a.front()) < scene.cost(b.front());
  });
  return families;
}

std::vector<int> family_grids(const KnobFamily& family, const ChartScene& scene) {
  if (!scene.limits().grids || method_rule(family.front().method) == RULE_PRODUCT) return {};
  return {std::begin(LIGHT_GRIDS), std::end(LIGHT_GRIDS)};
}

}  // namespace brume
