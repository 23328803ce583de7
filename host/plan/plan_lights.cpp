// Which lights a point asks, and where there are many, by which share each is chosen.
#include <algorithm>
#include <numeric>

#include "base/error.hpp"
#include "plan/plan_parts.hpp"

namespace brume {

namespace {

// About the irradiance that a light brings to the plan.
double power_of(const Light& l) {
  const double intensity = std::max({l.intensity.x, l.intensity.y, l.intensity.z});
  if (l.type == LIGHT_DIRECTIONAL || (l.type != LIGHT_SURFACE && l.falloff == FALLOFF_NONE)) return intensity;
  const double squared =
      double(l.position.x) * l.position.x + double(l.position.y) * l.position.y + double(l.position.z) * l.position.z;
  return intensity * (l.type == LIGHT_SURFACE ? double(l.outer) : 1.0) / std::max(1.0, squared);
}

// Every third bit of a number of 10 bits, from the lowest on.
std::uint32_t spread(std::uint32_t v) {
  v = (v | (v << 16)) & 0x030000FFu;
  v = (v | (v << 8)) & 0x0300F00Fu;
  v = (v | (v << 4)) & 0x030C30C3u;
  return (v | (v << 2)) & 0x09249249u;
}

// Place along a curve that visits neighbours soon after each other [Morton66].
std::uint32_t curve_place(const Light& l) {
  const auto cell = [](float x) { return static_cast<std::uint32_t>(std::clamp((x + 4.0) * 128, 0.0, 1023.0)); };
  return spread(cell(l.position.x)) | spread(cell(l.position.y)) << 1 | spread(cell(l.position.z)) << 2;
}

// Half of it by power, half evenly, so that no light that is near somewhere is missed for long. In the order of a curve
// through space: picks at even distances are then spread over the scene as well.
void shares_fill(RenderPlan& plan) {
  if (plan.lights.size() > LIGHTS_ENUMERATED)
    std::stable_sort(plan.lights.begin(), plan.lights.end(),
                     [](const Light& a, const Light& b) { return curve_place(a) < curve_place(b); });
  const double total = std::accumulate(plan.lights.begin(), plan.lights.end(), 0.0,
                                       [](double sum, const Light& l) { return sum + power_of(l); });
  const double count = static_cast<double>(plan.lights.size());
  double sum = 0;
  plan.light_shares.push_back(0);
  for (const Light& l : plan.lights) {
    sum += total > 0 ? 0.5 / count + 0.5 * power_of(l) / total : 1 / count;
    plan.light_shares.push_back(static_cast<float>(sum));
  }
  plan.light_shares.back() = 1;
}

// Of each surface that emits a light for each of its points.
void points_spread(const std::vector<Light>& sources, int points, RenderPlan& plan) {
  for (const Light& source : sources) {
    const bool surface = source.type == LIGHT_SURFACE;
    for (int i = 0; i < (surface ? std::max(points, 1) : 1); ++i) {
      plan.lights.push_back(source);
      plan.lights.back().point = i;
      if (surface) plan.lights.back().points = points;
    }
  }
}

[[noreturn]] void too_many(const SceneDesc& desc, const char* key, double asked) {
  throw InputError(desc.file.string() + ": /render/" + key + ": " + std::to_string(static_cast<long long>(asked)) +
                   " lights and points of lights are asked at every point; at most " + std::to_string(LIGHT_PICKS_MAX) +
                   " are allowed");
}

}  // namespace

bool plan_lights_extend(const RenderPlan& plan) {
  return std::any_of(plan.lights.begin(), plan.lights.end(),
                     [](const Light& l) { return l.type == LIGHT_SURFACE && l.points > 0; });
}

void plan_lights(const SceneDesc& desc, const FlatScene& scene, RenderPlan& plan) {
  const RenderDesc& render = desc.render;
  const int sources = static_cast<int>(scene.light_sources.size());
  const bool few = sources <= LIGHTS_ENUMERATED;
  int picks = render.light_picks;
  if (picks == LIGHT_PICKS_AUTO) picks = few ? 0 : std::max(LIGHT_PICKS, render.light_samples);
  const bool all = picks == 0 || picks >= sources;
  const int points = render.light_points == LIGHT_POINTS_CENTROID ? 0 : (all ? render.light_samples : 1);
  const auto surfaces = std::count_if(scene.light_sources.begin(), scene.light_sources.end(),
                                      [](const Light& l) { return l.type == LIGHT_SURFACE; });
  const double asked = double(sources) + double(surfaces) * std::max(points - 1, 0);
  if (all && asked > LIGHT_PICKS_MAX) too_many(desc, points > 1 ? "light_samples" : "light_picks", asked);
  if (render.integrator != INTEGRATOR_AMBIENT_OCCLUSION) points_spread(scene.light_sources, points, plan);
  plan.frame.light_count = static_cast<int>(plan.lights.size());
  plan.frame.light_picks = all ? plan.frame.light_count : picks;
  shares_fill(plan);
}

}  // namespace brume
