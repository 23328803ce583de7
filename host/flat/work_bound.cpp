// Refuses scenes whose rendering would not end in a lifetime of patience, with the number.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.hpp"
#include "flat/flatten_parts.hpp"

namespace brume {

namespace {

constexpr double LOOKUPS_MAX = 1e15;  // eleven days at 10^9 a second

// Density lookups (of a constant medium: light rays) of one view ray through a marched medium, along its longest way.
double ray_lookups(const FlatScene& scene, const Medium& m, double steps, double lights) {
  const bool constant = method_rule(m.method) == RULE_PRODUCT, traced = m.light_grids < 0 && !constant;
  const bool scatters = std::max({m.sigma_s.x, m.sigma_s.y, m.sigma_s.z}) > 0;
  return steps * (1 + (scatters ? lights * (traced ? steps : 1) : 0)) * (scene.frame.camera.spp);
}

}  // namespace

void work_check(const SceneDesc& desc, const std::vector<LoadedMedium>& media, const FlatScene& scene) {
  const Frame& f = scene.frame;
  const double pixels = double(f.crop_x1 - f.crop_x0) * (f.crop_y1 - f.crop_y0), lights = double(scene.lights.size());
  double lookups = 0, most = 0;
  const LoadedMedium* worst = nullptr;
  const auto steps_of = [](const LoadedMedium& m) { return std::ceil(std::sqrt(3.0) / m.step); };
  for (std::size_t i = 0; i < media.size(); ++i) {
    if (!method_has_step(media[i].method)) continue;
    const double its = pixels * ray_lookups(scene, scene.medium(i), steps_of(media[i]), lights);
    lookups += its;
    if (its <= most) continue;
    most = its;
    worst = &media[i];
  }
  if (lookups <= LOOKUPS_MAX) return;
  char text[320];
  std::snprintf(
      text, sizeof text,
      "%g asks for up to %.0f steps a ray and %.1g density lookups in all (%.0f pixels, %d samples, %.0f lights), "
      "more than the %g allowed; a longer step, a smaller film or \"shadow\": \"grid\" takes fewer",
      worst->step, steps_of(*worst), lookups, pixels, f.camera.spp, lights, LOOKUPS_MAX);
  throw InputError(desc.file.string() + ": " + (worst->desc->step ? worst->desc->place : "/render") + "/step: " + text);
}

}  // namespace brume
