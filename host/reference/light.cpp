// Lights, as kernels/shared/light.h defines them.
#include "reference/light.hpp"

#include <algorithm>
#include <cmath>

#include "reference/emitter.hpp"

namespace brume::reference {
namespace {

// Share of a spot's intensity: 0 outside, 1 inside, x²(3-2x) in the cosine between.
double spot_share(const Light& light, const dvec3& travel) {
  const double beside = 1 - glm::dot(travel, vec_unit(vec_promote(light.direction)));
  const double outer = light.outer, inner = light.inner;
  if (beside >= outer) return 0;
  if (beside <= inner) return 1;
  const double x = (outer - beside) / (outer - inner);
  return x * x * (3 - 2 * x);
}

}  // namespace

std::vector<LightPick> light_picks(const PlannedScene& scene, const RandomStream& random, uint n, bool all) {
  std::vector<LightPick> picks;
  if (all || scene.light_shares.empty() || scene.frame.light_picks == static_cast<int>(scene.lights.size())) {
    for (std::size_t i = 0; i < scene.lights.size(); ++i) picks.push_back({i, 1});
    return picks;
  }
  const auto count = static_cast<std::size_t>(scene.frame.light_picks);
  const auto xi = static_cast<float>(random.child(STREAM_LIGHT_CHOICE).at(n, RANDOM_PLACE));
  for (std::size_t i = 0; i < count; ++i) {
    // in single precision, as in the kernels, so that both pick the same lights
    const float at = (static_cast<float>(i) + xi) / static_cast<float>(count);
    const auto behind = std::upper_bound(scene.light_shares.begin(), scene.light_shares.end() - 1, at);
    const auto light = static_cast<std::size_t>(behind - scene.light_shares.begin()) - 1;
    const float share = scene.light_shares[light + 1] - scene.light_shares[light];
    picks.push_back({light, 1 / (static_cast<double>(count) * share)});
  }
  return picks;
}
static_assert(LIGHT_COUNT == 3 && FALLOFF_COUNT == 2, "light_at knows all");

LightSample light_at(const PlannedScene& scene, const Light& light, const dvec3& point, const RandomStream& random) {
  const dvec3 intensity = vec_promote(light.intensity);
  if (light.type == LIGHT_SURFACE) return emitter_at(scene, light, point, random);
  if (light.type == LIGHT_DIRECTIONAL) return {vec_unit(vec_promote(light.direction)), intensity, INFINITE, INFINITE};

  // in the light's own length
  const dvec3 from_light = point * std::exp2(-light.exponent) - vec_promote(light.position);
  const double distance = glm::length(from_light);
  if (distance == 0) return {};
  const dvec3 travel = from_light / distance;
  const double share = light.type == LIGHT_SPOT ? spot_share(light, travel) : 1;
  const double falloff = light.falloff == FALLOFF_INVERSE_SQUARE ? 1 / (distance * distance) : 1;
  const double way = distance * std::exp2(light.exponent);
  return {travel, intensity * (share * falloff), way, way};
}

}  // namespace brume::reference
