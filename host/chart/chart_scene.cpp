// See chart_scene.hpp.
#include "chart/chart_scene.hpp"

#include <algorithm>
#include <cmath>

#include "base/interrupt.hpp"
#include "base/statistics.hpp"
#include "base/stopwatch.hpp"
#include "film/film_write.hpp"
#include "flat/flatten.hpp"
#include "flat/media_methods.hpp"
#include "render/kernel_options.hpp"
#include "scene/families.hpp"

namespace brume {

namespace {

constexpr int RUNS_MOST = 7, RUNS_LEAST = 3;
constexpr double RUNS_SECONDS = 1;   // after which no more than the least are made
constexpr double LONG_SECONDS = 20;  // of one run, which then stands alone

std::vector<bool> constant_media(const SceneDesc& set) {
  std::vector<bool> constant;
  for (const MediumRow& row : media_rows(set)) constant.push_back(takes_constant(set, *row.desc));
  return constant;
}

KnobLimits limits_of(const FlatScene& flat, const SceneDesc& desc) {
  KnobLimits limits;
  for (const BrickGrid& grid : flat.grids)
    limits.cells = std::max({limits.cells, grid.cells_x, grid.cells_y, grid.cells_z});
  for (const MediumBody& body : flat.media) {
    const bool scatters = std::max({body.sigma_s.x, body.sigma_s.y, body.sigma_s.z}) > 0;
    const bool voxels = flat.placed[static_cast<std::size_t>(medium_placed(body))].grid >= 0;
    limits.grids = limits.grids || (scatters && voxels && !desc.lights.empty());
  }
  return limits;
}

// Segments along the longest way, and lookups of each.
double lookups_of(const MethodRow& row, const Knobs& knobs, double cells) {
  constexpr double COLLISIONS = 1;  // per cell: nobody knows before
  const double step = knobs.step;
  if (row.placement == PLACEMENT_PIECES) return cells * 0.05 / std::pow(knobs.tolerance, 0.25);
  if (row.placement == PLACEMENT_STEPS) return (row.rule == RULE_PRODUCT ? 1 : rule_lookups(row.rule)) / step;
  return cells * (row.placement == PLACEMENT_CELLS ? rule_lookups(row.rule) : COLLISIONS);
}

}  // namespace

ChartScene::ChartScene(const SceneDesc& desc, LoadedScene& loaded, Context& context, const ChartOptions& options)
    : desc_(desc), loaded_(loaded), context_(context), options_(options) {
  limits_ = limits_of(stage(exact_desc(desc, desc.film.spp)).scene, desc);
}

ChartScene::Stage& ChartScene::stage(const SceneDesc& set) {
  std::unique_ptr<Stage>& found = stages_[{set.render.level, constant_media(set)}];
  if (found) return *found;
  auto made = std::make_unique<Stage>();
  static_cast<FlatScene&>(made->scene) = scene_flatten(set, loaded_, bvh_width_for(options_.lanes));
  made->device = std::make_shared<DeviceScene>(context_, made->scene);
  found = std::move(made);
  return *found;
}

double ChartScene::cost(const Knobs& knobs) {
  const double pixels = double(desc_.film.size.x) * desc_.film.size.y, lights = double(desc_.lights.size());
  if (knobs.method == METHOD_NONE) return pixels * knobs.spp;
  const MethodRow row = method_row(knobs.method);
  const double ray = lookups_of(row, knobs, std::max(limits_at(limits_, knobs.level).cells, 1));
  const bool traces = knobs.light_grid == 0 && row.rule != RULE_PRODUCT;
  const double grid = 4 * lights * std::pow(double(knobs.light_grid), 3);
  const double points = knobs.rule == IN_SCATTERING_GAUSS2 ? 2 : 1;
  return pixels * knobs.spp * (100 + ray * (1 + lights * points * (traces ? ray / 3 : 1))) + grid;
}

std::optional<ChartPicture> ChartScene::render(const SceneDesc& set, bool timed, const Progress& go_on) {
  Stage& its = stage(set);
  const RenderPlan plan = plan_render(set, its.scene, {options_.crop, false, &its.piece_errors});
  ChartPicture picture;
  // A program that was built for another setting took as long for this one.
  const std::string kernel = kernel_options(its.scene, plan, context_.device(), options_.lanes, options_.generic);
  // Each run has a renderer of its own: one that has rendered has its light grids already.
  const auto run = [&](Film& film) {
    Renderer renderer(context_, its.device, plan, {options_.lanes, options_.generic, 0});
    picture.build_seconds = build_seconds_.emplace(kernel, renderer.stats().kernel_build_s).first->second;
    const Stopwatch watch;
    const bool complete = renderer.render(film, go_on);
    picture.lookups = renderer.stats().lookups;
    return complete ? watch.seconds() : -1.0;
  };
  Film film(set.film.size);
  const double first = run(film);
  if (first < 0) return std::nullopt;
  const Frame& frame = plan.frame;
  const Film shown = film.cut({frame.crop_x0, frame.crop_y0}, {frame.crop_x1, frame.crop_y1});
  picture.image = film_image(shown);
  picture.expected_error = shown.aov(AOV_ERROR).values;
  std::vector<double> times;
  double spent = 0;
  while (timed && first < LONG_SECONDS && int(times.size()) < (spent < RUNS_SECONDS ? RUNS_MOST : RUNS_LEAST)) {
    Film again(set.film.size);
    const double seconds = run(again);
    if (seconds < 0) return std::nullopt;
    times.push_back(seconds);
    spent += seconds;
  }
  if (times.empty()) times = {first};
  const Summary summary = summary_of(times);
  picture.seconds = summary.median;
  picture.seconds_spread = summary.spread;
  picture.runs = static_cast<int>(times.size());
  return picture;
}

ChartScene::PixelTimes ChartScene::render_pixels(const SceneDesc& set, Film& film, const WorkList& work) {
  Stage& its = stage(set);
  const RenderPlan plan = plan_render(set, its.scene, {options_.crop, false, &its.piece_errors});
  Renderer renderer(context_, its.device, plan, {options_.lanes, options_.generic, 0});
  if (!renderer.render(film, work, [](double) { return !interrupt_requested(); })) interrupt_check();
  PixelTimes times;
  for (const PassStats& pass : renderer.stats().passes) {
    if (pass.name == "light_grid") times.once = pass.seconds;
  }
  times.pixels = renderer.stats().render_s - times.once;
  return times;
}

std::optional<ChartPicture> ChartScene::render_timed(const SceneDesc& set, const Progress& go_on) {
  return render(set, true, go_on);
}

std::optional<ChartPicture> ChartScene::render_once(const SceneDesc& set, const Progress& go_on) {
  return render(set, false, go_on);
}

const PlannedScene& ChartScene::exact_scene(int spp) {
  const SceneDesc set = exact_desc(desc_, spp);
  Stage& its = stage(set);
  static_cast<RenderPlan&>(its.scene) = plan_render(set, its.scene, {options_.crop, false, &its.piece_errors});
  return its.scene;
}

std::string ChartScene::exact_method() {
  std::string names;
  for (const MediumWalk& walk : exact_scene(desc_.film.spp).walks) {
    const std::string name(family_name(method_family(), walk.method));
    if (names.find(name) == std::string::npos) names += (names.empty() ? "" : ", ") + name;
  }
  return names.empty() ? "none" : names;
}

}  // namespace brume
