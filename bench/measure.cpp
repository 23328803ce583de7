// See measure.hpp.
#include "measure.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include "base/interrupt.hpp"
#include "film/film_write.hpp"
#include "flat/flatten.hpp"
#include "plan/planned_scene.hpp"
#include "render/device_scene.hpp"
#include "shared/method.h"

namespace brume::bench {

namespace {

constexpr Setting SETTINGS[] = {
    {"dda_gauss2/trace", METHOD_DDA_GAUSS2, 0, SHADOW_TRACE},  // exact: the others' errors are against it
    {"dda_nearest/trace", METHOD_DDA_NEAREST, 0, SHADOW_TRACE},
    {"dda_midpoint/trace", METHOD_DDA_MIDPOINT, 0, SHADOW_TRACE},
    {"march_midpoint_1/trace", METHOD_MARCH_MIDPOINT, 1, SHADOW_TRACE},
    {"march_midpoint_jitter_1/trace", METHOD_MARCH_MIDPOINT_JITTER, 1, SHADOW_TRACE},
    {"march_regular_1/trace", METHOD_MARCH_REGULAR, 1, SHADOW_TRACE},
    {"march_regular_jitter_1/trace", METHOD_MARCH_REGULAR_JITTER, 1, SHADOW_TRACE},
    {"delta_tracking/trace", METHOD_DELTA_TRACKING, 0, SHADOW_TRACE},
    {"ratio_tracking/trace", METHOD_RATIO_TRACKING, 0, SHADOW_TRACE},
    {"residual_ratio/trace", METHOD_RESIDUAL_RATIO, 0, SHADOW_TRACE},
    {"dda_midpoint/grid256", METHOD_DDA_MIDPOINT, 0, SHADOW_GRID, 256},
    {"dda_midpoint/grid128", METHOD_DDA_MIDPOINT, 0, SHADOW_GRID, 128},
    {"dda_midpoint/grid64", METHOD_DDA_MIDPOINT, 0, SHADOW_GRID, 64},
    {"dda_midpoint/grid32", METHOD_DDA_MIDPOINT, 0, SHADOW_GRID, 32},
    {"dda_midpoint/grid16", METHOD_DDA_MIDPOINT, 0, SHADOW_GRID, 16},
    {"dda_midpoint_f16/grid128", METHOD_DDA_MIDPOINT, 0, SHADOW_GRID, 128, STORAGE_F16},
    {"dda_midpoint_u8/grid128", METHOD_DDA_MIDPOINT, 0, SHADOW_GRID, 128, STORAGE_U8},
    {"march_midpoint_0.5/grid64", METHOD_MARCH_MIDPOINT, 0.5, SHADOW_GRID, 64},  // to 4: cost against steps
    {"march_midpoint_1/grid64", METHOD_MARCH_MIDPOINT, 1, SHADOW_GRID, 64},
    {"march_midpoint_2/grid64", METHOD_MARCH_MIDPOINT, 2, SHADOW_GRID, 64},
    {"march_midpoint_4/grid64", METHOD_MARCH_MIDPOINT, 4, SHADOW_GRID, 64},
    {"march_midpoint_2/grid32", METHOD_MARCH_MIDPOINT, 2, SHADOW_GRID, 32},
    {"march_midpoint_4/grid32", METHOD_MARCH_MIDPOINT, 4, SHADOW_GRID, 32},
    {"march_midpoint_6/grid24", METHOD_MARCH_MIDPOINT, 6, SHADOW_GRID, 24},
    {"adaptive_1e-1/trace", METHOD_ADAPTIVE, 0, SHADOW_TRACE, 64, STORAGE_F32, 1e-1},
    {"adaptive_1e-2/trace", METHOD_ADAPTIVE, 0, SHADOW_TRACE, 64, STORAGE_F32, 1e-2},
    {"adaptive_1e-3/trace", METHOD_ADAPTIVE, 0, SHADOW_TRACE, 64, STORAGE_F32, 1e-3},
    {"adaptive_1e-2/grid64", METHOD_ADAPTIVE, 0, SHADOW_GRID, 64, STORAGE_F32, 1e-2},
};

constexpr bool has_setting(int method) {
  for (const Setting& setting : SETTINGS)
    if (setting.method == method) return true;
  return false;
}

// The workloads are grids: what fits a constant density only has nothing to do there.
#define ROW(id, name, fits, placement, rule, share, jitter, draws, exact, help) \
  static_assert(has_setting(METHOD_##id) || !((fits) & (FITS_NEAREST | FITS_TRILINEAR)), "no setting measures " name);
BRUME_METHODS(ROW)
#undef ROW

// Of the medium: trilinear, it fades over one voxel more.
double workload_longest(const Workload& work) {
  const ivec3 size = work.grid().size();
  return work.voxel_size() * (std::max({size.x, size.y, size.z}) + 1);
}

}  // namespace

const std::vector<Setting>& settings() {
  static const std::vector<Setting> all(std::begin(SETTINGS), std::end(SETTINGS));
  return all;
}

SceneDesc scene_of(const Workload& work, const Setting& setting) {
  SceneDesc desc = work.desc;
  if (method_fits(setting.method) == FITS_NEAREST) desc.media[0].interpolation = INTERPOLATION_NEAREST;
  desc.render.method = setting.method;
  if (setting.step_voxels > 0) desc.render.step = setting.step_voxels * work.voxel_size() / workload_longest(work);
  if (setting.tolerance > 0) desc.render.tolerance = setting.tolerance;
  desc.render.shadow = setting.shadow;
  desc.render.light_grid = setting.light_grid;
  desc.render.storage = setting.storage;
  return desc;
}

const FlatScene& flat_scene(const Workload& work, const Setting& setting, int lanes) {
  static std::map<std::tuple<std::string, int, int>, FlatScene> known;
  const SceneDesc desc = scene_of(work, setting);
  const auto key = std::make_tuple(work.name, desc.media[0].interpolation, lanes);
  const auto found = known.find(key);
  if (found != known.end()) return found->second;
  return known[key] = scene_flatten(desc, *work.loaded, bvh_width_for(lanes));
}

RenderPlan plan_of(const Workload& work, const Setting& setting, const FlatScene& flat) {
  return plan_render(scene_of(work, setting), flat, {});
}

const Image& exact_picture(Context& context, const Workload& work) {
  static std::map<std::string, Image> known;
  const auto found = known.find(work.name);
  if (found != known.end()) return found->second;
  const int lanes = lanes_choose(context.device(), 0);
  const FlatScene& flat = flat_scene(work, settings().front(), lanes);
  Renderer renderer(context, std::make_shared<DeviceScene>(context, flat), plan_of(work, settings().front(), flat),
                    {lanes, false, 0});
  Film film(work.desc.film.size);
  if (!renderer.render(film, [](double) { return !interrupt_requested(); })) interrupt_check();
  return known[work.name] = film_image(film);
}

}  // namespace brume::bench
