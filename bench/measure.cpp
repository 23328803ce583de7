// See measure.hpp.
#include "measure.hpp"

#include <map>

#include "base/interrupt.hpp"
#include "flat/flatten.hpp"
#include "shared/method.h"
#include "volume/volume_file.hpp"

namespace brume::bench {

const std::vector<Setting>& settings() {
  static const std::vector<Setting> all{
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
  };
  return all;
}

namespace {

double longest_side(const Workload& work) {
  const VolumeGridInfo info = volume_list(work.file).front();
  const glm::i64vec3 size = glm::i64vec3(info.index_max) - glm::i64vec3(info.index_min);
  return work.voxel_size * static_cast<double>(std::max({size.x, size.y, size.z}) + 2);
}

}  // namespace

SceneDesc scene_of(const Workload& work, const Setting& setting) {
  SceneDesc desc = work.desc;
  if (setting.method == METHOD_DDA_NEAREST) desc.media[0].interpolation = INTERPOLATION_NEAREST;
  desc.render.method = setting.method;
  if (setting.step_voxels > 0) desc.render.step = setting.step_voxels * work.voxel_size / longest_side(work);
  desc.render.shadow = setting.shadow;
  desc.render.light_grid = setting.light_grid;
  desc.render.storage = setting.storage;
  return desc;
}

FlatScene flat_scene(const Workload& work, const Setting& setting, int lanes) {
  return flatten(scene_of(work, setting), {bvh_width_for(lanes), {}});
}

Image picture(const Film& film) {
  Image image;
  image.width = film.size().x;
  image.height = film.size().y;
  image.channels = 3;
  image.channel_names = {"R", "G", "B"};
  for (const FilmPixel& p : film.pixels())
    for (const float sum : {p.radiance.x, p.radiance.y, p.radiance.z}) image.values.push_back(sum / p.samples);
  return image;
}

const Image& exact_picture(Context& context, const Workload& work) {
  static std::map<std::string, Image> known;
  const auto found = known.find(work.name);
  if (found != known.end()) return found->second;
  const int lanes = lanes_choose(context.device(), 0);
  const FlatScene scene = flat_scene(work, settings().front(), lanes);
  Renderer renderer(context, scene, {lanes, false, 0});
  Film film(work.desc.film.size);
  if (!renderer.render(film, [](double) { return !interrupt_requested(); })) interrupt_check();
  return known[work.name] = picture(film);
}

}  // namespace brume::bench
