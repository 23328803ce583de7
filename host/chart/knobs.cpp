// See knobs.hpp.
#include "chart/knobs.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <tuple>

#include "base/error.hpp"
#include "base/number_text.hpp"
#include "flat/media_methods.hpp"
#include "scene/families.hpp"

namespace brume {

namespace {

// Which methods a sweep is for.
bool any_method(const MethodRow&) { return true; }
bool draws_nothing(const MethodRow& row) { return row.draws == DRAWS_NOTHING; }
bool takes_rules(const MethodRow& row) {
  return draws_nothing(row) && row.placement != PLACEMENT_PIECES && row.rule != RULE_LINEAR;
}
bool draws(const MethodRow& row) { return row.draws != DRAWS_NOTHING; }
// Light grids serve all that scatter and do not collide; a constant density needs none.
bool walks(const MethodRow& row) {
  return row.draws != DRAWS_COLLISIONS && row.rule != RULE_PRODUCT && row.rule != RULE_LINEAR;
}
bool samples_middles(const MethodRow& row) { return walks(row) && row.draws == DRAWS_NOTHING && row.share == 0.5f; }
bool reads_voxels(const MethodRow& row) { return draws_nothing(row) && row.rule != RULE_PRODUCT; }

constexpr int ONE_LIGHT_GRID = 64;  // the default of render.light_grid
constexpr int SPPS[] = {1, 4, 16, 64};
constexpr int PLAIN_SPPS[] = {1, 2, 4, 8, 16, 32, 64};  // without media nothing else can be turned
constexpr int COARSEST = 3, FINEST = 10;                // steps of 2^-COARSEST to 2^-FINEST of the side
constexpr int FINEST_CONSTANT = 7;

enum Steps { COARSE_STEP, CELL_STEP, ALL_STEPS };
enum Grids { TRACED, ONE_GRID, ALL_GRIDS };
enum Spps { SCENE_SPP, ALL_SPPS };
struct Sweep {
  bool (*fits)(const MethodRow&);
  Steps steps;
  Grids grids;
  Spps spps;
  int storage, rule;
  int level = 0;
};
constexpr Sweep SWEEPS[] = {
    {any_method, ALL_STEPS, TRACED, SCENE_SPP, STORAGE_F32, IN_SCATTERING_SEGMENT},
    {draws, COARSE_STEP, TRACED, ALL_SPPS, STORAGE_F32, IN_SCATTERING_SEGMENT},
    {walks, ALL_STEPS, ONE_GRID, SCENE_SPP, STORAGE_F32, IN_SCATTERING_SEGMENT},
    {samples_middles, ALL_STEPS, ALL_GRIDS, SCENE_SPP, STORAGE_F32, IN_SCATTERING_SEGMENT},
    {takes_rules, ALL_STEPS, TRACED, SCENE_SPP, STORAGE_F32, IN_SCATTERING_RECTANGLE},
    {takes_rules, ALL_STEPS, TRACED, SCENE_SPP, STORAGE_F32, IN_SCATTERING_GAUSS2},
    {reads_voxels, CELL_STEP, ONE_GRID, SCENE_SPP, STORAGE_F16, IN_SCATTERING_SEGMENT},
    {reads_voxels, CELL_STEP, ONE_GRID, SCENE_SPP, STORAGE_U8, IN_SCATTERING_SEGMENT},
    {reads_voxels, ALL_STEPS, TRACED, SCENE_SPP, STORAGE_F32, IN_SCATTERING_SEGMENT, LEVELS[0]},
    {reads_voxels, ALL_STEPS, TRACED, SCENE_SPP, STORAGE_F32, IN_SCATTERING_SEGMENT, LEVELS[1]},
};

constexpr int LEVEL_CELLS = 16;  // fewer along the longest side say nothing of a volume

int finest_step(const KnobLimits& limits) {
  if (limits.cells == 0) return FINEST_CONSTANT;
  const int half_a_cell = static_cast<int>(std::lround(std::log2(limits.cells))) + 1;
  return std::clamp(half_a_cell, COARSEST + 3, FINEST);
}

constexpr double TOLERANCES[] = {0.3, 0.1, 0.03, 0.01, 3e-3, 1e-3, 3e-4, 1e-4, 1e-5};
constexpr double ONE_TOLERANCE = 1e-3;  // the default of render.tolerance

// What says how fine a method is: one of the two, or neither.
struct Fineness {
  double step = 0, tolerance = 0;
};

// As powers of 1/2. Where other knobs are turned: about a cell, and 4 where many samples are to mend a coarse step.
std::vector<double> steps_of(const MethodRow& row, Steps steps, const KnobLimits& limits) {
  if (row.placement != PLACEMENT_STEPS) return {0};
  const int finest = finest_step(limits);
  if (steps == CELL_STEP) return {std::exp2(1 - finest)};
  if (steps == COARSE_STEP) return {std::exp2(3 - finest)};
  return steps_halving(limits, 0);
}

std::vector<int> grids_of(Grids grids, const KnobLimits& limits) {
  if (grids == TRACED) return {0};
  if (!limits.grids) return {};
  if (grids == ONE_GRID) return {ONE_LIGHT_GRID};
  return {std::begin(LIGHT_GRIDS), std::end(LIGHT_GRIDS)};
}

std::vector<Fineness> finenesses_of(const MethodRow& row, Steps steps, const KnobLimits& limits) {
  std::vector<Fineness> list;
  if (row.placement == PLACEMENT_PIECES) {
    if (steps != ALL_STEPS) return {{0, ONE_TOLERANCE}};
    for (const double tolerance : TOLERANCES) list.push_back({0, tolerance});
  } else {
    for (const double step : steps_of(row, steps, limits)) list.push_back({step, 0});
  }
  return list;
}

void sweep_add(const Sweep& sweep, int method, const KnobLimits& full, int spp, std::set<std::string>& known,
               std::vector<Knobs>& list) {
  const MethodRow row = method_row(method);
  const KnobLimits limits = limits_at(full, sweep.level);
  if (!sweep.fits(row) || (sweep.level > 0 && limits.cells < LEVEL_CELLS)) return;
  const std::vector<int> spps =
      sweep.spps == SCENE_SPP ? std::vector<int>{spp} : std::vector<int>(std::begin(SPPS), std::end(SPPS));
  // Of a scene without light grids storage is told by tracing.
  const bool stored = sweep.storage != STORAGE_F32;
  for (const int grid : grids_of(stored && !limits.grids ? TRACED : sweep.grids, limits))
    for (const Fineness& fine : finenesses_of(row, sweep.steps, limits))
      for (const int samples : spps) {
        const Knobs knobs{method, fine.step, grid, sweep.storage, sweep.rule, samples, fine.tolerance, sweep.level};
        if (known.insert(knobs_id(knobs)).second) list.push_back(knobs);
      }
}

}  // namespace

std::string knobs_method(const Knobs& knobs) {
  return knobs.method == METHOD_NONE ? "none" : std::string(family_name(method_family(), knobs.method));
}

std::string knobs_id(const Knobs& knobs) {
  std::string id = knobs_method(knobs);
  if (knobs.method != METHOD_NONE) {
    if (knobs.step > 0) id += "-step" + number_text(knobs.step);
    if (knobs.tolerance > 0) id += "-tolerance" + number_text(knobs.tolerance);
    if (knobs.level > 0) id += "-level" + std::to_string(knobs.level);
    id += knobs.light_grid > 0 ? "-grid" + std::to_string(knobs.light_grid) : "-trace";
    id += "-" + std::string(family_name(storage_family(), knobs.storage));
    if (!(knobs.tolerance > 0)) id += "-" + std::string(family_name(in_scattering_family(), knobs.rule));
  }
  return id + "-spp" + std::to_string(knobs.spp);
}

SceneDesc knobs_apply(const SceneDesc& desc, const Knobs& knobs) {
  SceneDesc set = desc;
  set.film.spp = knobs.spp;
  for (MediumDesc& medium : set.media) medium.method.reset(), medium.step.reset(), medium.tolerance.reset();
  if (knobs.method == METHOD_NONE) return set;
  set.render.method = knobs.method;
  if (knobs.step > 0) set.render.step = knobs.step;
  if (knobs.tolerance > 0) set.render.tolerance = knobs.tolerance;
  set.render.shadow = knobs.light_grid > 0 ? SHADOW_GRID : SHADOW_TRACE;
  if (knobs.light_grid > 0) set.render.light_grid = knobs.light_grid;
  set.render.storage = knobs.storage;
  set.render.level = knobs.level;
  set.render.in_scattering = knobs.rule;
  return set;
}

std::vector<int> methods_parse(const std::string& text) {
  std::vector<int> methods;
  std::istringstream names(text);
  for (std::string name; std::getline(names, name, ',');) {
    const FamilyRow* row = family_find(method_family(), name);
    if (!row) throw InputError("--methods: unknown method '" + name + "'; known: " + family_names(method_family()));
    methods.push_back(row->id);
  }
  return methods;
}

std::vector<int> methods_fitting(const SceneDesc& desc, const std::vector<int>& wanted) {
  std::vector<int> fitting;
  std::string names;
  for (const FamilyRow& row : method_family()) {
    const SceneDesc set = knobs_apply(desc, {row.id});
    const std::vector<MediumRow> media = media_rows(set);
    const bool fits = std::any_of(media.begin(), media.end(),
                                  [&](const MediumRow& m) { return method_resolve(set, *m.desc) == row.id; });
    if (!fits) continue;
    fitting.push_back(row.id);
    names += (names.empty() ? "" : ", ") + std::string(row.name);
  }
  if (wanted.empty()) return fitting;
  for (const int method : wanted)
    if (std::find(fitting.begin(), fitting.end(), method) == fitting.end())
      throw InputError("--methods: '" + std::string(family_name(method_family(), method)) + "' fits no medium of " +
                       desc.file.string() + (names.empty() ? ", which has none" : "; these do: " + names));
  fitting.erase(std::remove_if(fitting.begin(), fitting.end(),
                               [&](int m) { return std::find(wanted.begin(), wanted.end(), m) == wanted.end(); }),
                fitting.end());
  return fitting;
}

std::vector<Knobs> knobs_list(const std::vector<int>& methods, const KnobLimits& limits, int spp) {
  std::vector<Knobs> list;
  if (methods.empty())
    for (const int samples : PLAIN_SPPS) list.push_back({METHOD_NONE, 0, 0, STORAGE_F32, 0, samples});
  std::set<std::string> known;
  for (const Sweep& sweep : SWEEPS)
    for (const int method : methods) sweep_add(sweep, method, limits, spp, known, list);
  return list;
}

KnobLimits limits_at(KnobLimits limits, int level) {
  for (int i = 0; i < level; ++i) limits.cells = (limits.cells + 1) / 2;
  return limits;
}

std::vector<double> steps_halving(const KnobLimits& limits, int beyond) {
  std::vector<double> all;
  for (int k = COARSEST; k <= finest_step(limits) + beyond; ++k) all.push_back(std::exp2(-k));
  return all;
}

std::vector<double> tolerances_all() { return {std::begin(TOLERANCES), std::end(TOLERANCES)}; }

void knobs_order(std::vector<Knobs>& list, int spp, const std::function<double(const Knobs&)>& cost) {
  struct Place {
    bool other_samples;
    int rank;  // by cost, among those of its method
    double cost;
    Knobs knobs;
  };
  std::vector<Place> places;
  places.reserve(list.size());
  for (const Knobs& knobs : list) places.push_back({knobs.spp != spp, 0, cost(knobs), knobs});
  const auto sort = [&] {
    std::stable_sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
      return std::tie(a.other_samples, a.rank, a.cost) < std::tie(b.other_samples, b.rank, b.cost);
    });
  };
  sort();
  std::map<int, int> listed;  // of a method
  for (Place& place : places) place.rank = listed[place.knobs.method]++;
  sort();
  std::transform(places.begin(), places.end(), list.begin(), [](const Place& place) { return place.knobs; });
}

SceneDesc exact_desc(const SceneDesc& desc, int spp) {
  constexpr double FINE_CONSTANT_STEP = 1.0 / 512;  // for light that changes inside of a constant medium
  constexpr std::size_t LIGHTS_ALL = 256;           // more are chosen among by default too
  SceneDesc exact = knobs_apply(desc, {METHOD_NONE, 0, 0, STORAGE_F32, 0, spp});
  exact.render.method = METHOD_AUTO;
  exact.render.step = FINE_CONSTANT_STEP;
  exact.render.shadow = SHADOW_TRACE;
  exact.render.storage = STORAGE_F32;
  exact.render.level = 0;
  exact.render.in_scattering = IN_SCATTERING_GAUSS2;
  exact.render.roulette = 0;
  if (exact.lights.size() <= LIGHTS_ALL) exact.render.light_picks = 0;
  return exact;
}

SceneDesc exact_desc_fine(const SceneDesc& desc, int spp, const KnobLimits& limits) {
  constexpr double STEPS_IN_A_CELL = 4;
  SceneDesc exact = exact_desc(desc, spp);
  const auto is_density = [](const MediumDesc& m) { return m.type != MEDIUM_LIQUID; };
  if (std::any_of(desc.media.begin(), desc.media.end(), is_density)) exact.render.method = METHOD_MARCH_MIDPOINT;
  exact.render.step = 1 / (STEPS_IN_A_CELL * limits.cells);
  return exact;
}

}  // namespace brume
