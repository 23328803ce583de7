// Refuses scenes whose rendering would not end in a lifetime of patience, with the number.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.hpp"
#include "flat/media_methods.hpp"
#include "plan/plan_parts.hpp"

namespace brume {

namespace {

constexpr double LOOKUPS_MAX = 1e15;  // eleven days at 10^9 a second

// Density lookups (of a constant medium: light rays) of one view ray through a marched medium, along its longest way.
double ray_lookups(const Medium& m, double steps, double lights, int spp) {
  const bool constant = method_rule(m.method) == RULE_PRODUCT, traced = m.light_grids < 0 && !constant;
  const bool scatters = std::max({m.sigma_s.x, m.sigma_s.y, m.sigma_s.z}) > 0;
  return steps * (1 + (scatters ? lights * (traced ? steps : 1) : 0)) * spp;
}

}  // namespace

void work_check(const SceneDesc& desc, const FlatScene& scene, const RenderPlan& plan) {
  const Frame& f = plan.frame;
  const double pixels = double(f.crop_x1 - f.crop_x0) * (f.crop_y1 - f.crop_y0), lights = double(plan.lights.size());
  const std::vector<MediumRow> rows = media_rows(desc);
  const auto step_of = [&](std::size_t i) {
    const std::optional<int>& slices = rows[i].desc->liquid.slices;
    return slices ? 1.0 / *slices : rows[i].desc->step.value_or(desc.render.step);
  };
  const auto steps_of = [&](std::size_t i) { return std::ceil(std::sqrt(3.0) / step_of(i)); };
  double lookups = 0, most = 0;
  std::size_t worst = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!method_has_step(plan.walks[i].method)) continue;
    const Medium m = medium_of(scene, plan.walks[i], i);
    const double its = pixels * ray_lookups(m, steps_of(i), lights, f.camera.spp);
    lookups += its;
    if (its > most) worst = i;
    most = std::max(most, its);
  }
  if (lookups <= LOOKUPS_MAX) return;
  char text[320];
  std::snprintf(
      text, sizeof text,
      "%g asks for up to %.0f steps a ray and %.1g density lookups in all (%.0f pixels, %d samples, %.0f lights), "
      "more than the %g allowed; a longer step, a smaller film or \"shadow\": \"grid\" takes fewer",
      step_of(worst), steps_of(worst), lookups, pixels, f.camera.spp, lights, LOOKUPS_MAX);
  const MediumDesc& m = *rows[worst].desc;
  throw InputError(desc.file.string() + ": " + (m.step ? m.place : "/render") + "/step: " + text);
}

}  // namespace brume
