// See render_plan.hpp and plan_parts.hpp.
#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "flat/media_methods.hpp"
#include "plan/plan_parts.hpp"

namespace brume {

namespace {

void crop_set(Frame& frame, const std::array<int, 4>& crop, glm::ivec2 size) {
  const bool whole = crop[0] == crop[2] && crop[1] == crop[3];
  frame.crop_x0 = whole ? 0 : crop[0];
  frame.crop_y0 = whole ? 0 : crop[1];
  frame.crop_x1 = whole ? size.x : crop[2];
  frame.crop_y1 = whole ? size.y : crop[3];
  if (frame.crop_x0 < 0 || frame.crop_y0 < 0 || frame.crop_x0 >= frame.crop_x1 || frame.crop_y0 >= frame.crop_y1 ||
      frame.crop_x1 > size.x || frame.crop_y1 > size.y)
    throw InputError("--crop: expected X0,Y0,X1,Y1 with 0 <= X0 < X1 <= " + std::to_string(size.x) +
                     " and 0 <= Y0 < Y1 <= " + std::to_string(size.y));
}

// The rate at which trackers collide, per density: the largest extinction. A medium that only glows has none: eight
// collisions on the longest way (flat units) through its densest part then, else its light would never be sampled.
float track_sigma_of(const MediumBody& m, const MediumSize& size) {
  const double largest = std::max({m.sigma_a.x + m.sigma_s.x, m.sigma_a.y + m.sigma_s.y, m.sigma_a.z + m.sigma_s.z});
  return static_cast<float>(largest > 0 || !(size.densest > 0) ? largest : 8 / (size.longest * size.densest));
}

bool is_constant(const FlatScene& flat, std::size_t medium) {
  return flat.placed[static_cast<std::size_t>(medium_placed(flat.media[medium]))].grid < 0;
}

// Distance between so many planes across the view through the whole of a medium.
double slice_distance(const FlatScene& flat, std::size_t medium, const Frame& frame, int slices) {
  const PlacedGrid& placed = flat.placed[static_cast<std::size_t>(medium_placed(flat.media[medium]))];
  const Packed3 lo = placed.lo, hi = placed.hi, view = frame.camera.forward;
  const float* m = placed.world_from_cell.m;
  double extent = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double along = double(m[axis]) * view.x + double(m[4 + axis]) * view.y + double(m[8 + axis]) * view.z;
    const float sides[3] = {hi.x - lo.x, hi.y - lo.y, hi.z - lo.z};
    extent += std::abs(along) * sides[axis];
  }
  return extent / slices;
}

MediumWalk walk_plan(const SceneDesc& desc, const MediumDesc& m, const FlatScene& flat, std::size_t medium,
                     const Frame& frame) {
  const int method = method_resolve(desc, m);
  if (takes_constant(desc, m) != is_constant(flat, medium))
    throw InputError(desc.file.string() + ": " + m.place + ": the scene was flattened for another kind of method");
  MediumWalk walk{method, 0, LIGHT_GRADE, 0, -1, 0, 0, 0, 0, 0, 0};
  walk.step = static_cast<float>(m.step.value_or(desc.render.step) * flat.sizes[medium].longest);
  if (m.type == MEDIUM_LIQUID && m.liquid.slices) {
    walk.step = static_cast<float>(slice_distance(flat, medium, frame, *m.liquid.slices));
    walk.slices = 1;
  }
  if (!is_constant(flat, medium)) walk.track_sigma = track_sigma_of(flat.media[medium], flat.sizes[medium]);
  return walk;
}

// Depths to the lights are interpolated where they change smoothly along a view ray and come without random numbers,
// and where kernels walk the media side by side.
bool wants_light_ladder(const RenderPlan& plan) {
  const bool draws = (plan.draws & ~(1u << DRAWS_NOTHING)) != 0 || plan.frame.roulette > 0 || plan_lights_extend(plan);
  const bool adapts = std::any_of(plan.walks.begin(), plan.walks.end(),
                                  [](const MediumWalk& walk) { return method_has_tolerance(walk.method); });
  const bool all = plan.frame.light_picks == plan.frame.light_count && plan.frame.light_count <= LADDER_LIGHTS;
  return all && !draws && !adapts && plan.walks.size() <= MEDIA_TOGETHER;
}

void plan_media(const SceneDesc& desc, const FlatScene& flat, PieceErrors& known, RenderPlan& plan) {
  const std::vector<MediumRow> rows = media_rows(desc);
  media_check(desc, rows, plan.plan_notes);
  if (rows.size() != flat.media.size())
    throw InputError(desc.file.string() + ": /media: the scene was flattened with others");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    plan.walks.push_back(walk_plan(desc, *rows[i].desc, flat, i, plan.frame));
    if (method_has_tolerance(plan.walks.back().method))
      adaptive_plan(rows[i].desc->tolerance.value_or(desc.render.tolerance), flat, i, known, plan);
    plan.draws |= 1u << method_draws(plan.walks.back().method);
  }
  std::vector<Medium> media;
  for (std::size_t i = 0; i < rows.size(); ++i) media.push_back(medium_of(flat, plan.walks[i], i));
  const std::vector<int> light_grids = light_grids_plan(desc, media, plan);
  for (std::size_t i = 0; i < rows.size(); ++i) plan.walks[i].light_grids = light_grids[i];
  plan.frame.takes_ends = !((plan.draws >> DRAWS_COLLISIONS) & 1u);
  plan.frame.light_ladder = wants_light_ladder(plan);
}

}  // namespace

Medium medium_of(const FlatScene& flat, const MediumWalk& walk, std::size_t medium) {
  const PlacedGrid& placed = flat.placed[static_cast<std::size_t>(medium_placed(flat.media[medium]))];
  static constexpr BrickGrid NONE{};
  const BrickGrid& grid = placed.grid < 0 ? NONE : flat.grids[static_cast<std::size_t>(placed.grid)];
  return medium_join(&grid, &placed, &flat.media[medium], &walk);
}

RenderPlan plan_render(const SceneDesc& desc, const FlatScene& flat, const PlanOptions& options) {
  RenderPlan plan;
  plan_camera(desc, flat, plan.frame);
  plan.frame.in_scattering = in_scattering_resolve(desc);
  plan_lights(desc, flat, plan);
  plan.frame.list_count = static_cast<int>(flat.shape_list.size());
  plan.frame.shape_root = flat.shape_root;
  plan.frame.triangle_count = static_cast<int>(flat.world_triangles());
  plan.frame.instance_root = flat.instance_root;
  plan.frame.medium_count = static_cast<int>(flat.media.size());
  plan.frame.hides_background = options.hide_background;
  plan.storage = desc.render.storage;
  PieceErrors own;
  plan_media(desc, flat, options.piece_errors ? *options.piece_errors : own, plan);
  crop_set(plan.frame, options.crop, desc.film.size);
  work_check(desc, flat, plan);
  return plan;
}

}  // namespace brume
