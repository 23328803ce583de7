// Lights, and where there are many, by which share each is chosen.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numeric>

#include "flat/flatten_parts.hpp"

namespace brume {

namespace {

// A light beyond FAR_AWAY gets a unit of length of its own, in which it is no more than FAR_AWAY away.
void light_place(const LightDesc& desc, const FlatScene& scene, Light& light) {
  const dvec3 position = scene.point(desc.position), size = glm::abs(position);
  light.exponent =
      std::max(0, static_cast<int>(std::ceil(std::log2(std::max({size.x, size.y, size.z, FAR_AWAY}) / FAR_AWAY))));
  const double length = std::exp2(light.exponent);
  light.position = packed(position / length);
  if (light.falloff == FALLOFF_INVERSE_SQUARE)
    light.intensity = packed(desc.intensity / (scene.unit * length) / (scene.unit * length));
}

float one_minus_cos(double degrees) {
  const double half = std::sin(glm::radians(0.5 * degrees));
  return static_cast<float>(2 * half * half);
}

Light light_flatten(const LightDesc& l, const FlatScene& scene) {
  Light light{};
  light.type = l.type;
  light.falloff = l.falloff;
  light.direction = packed(glm::normalize(l.direction));
  light.intensity = packed(l.intensity);
  if (l.type != LIGHT_DIRECTIONAL) light_place(l, scene, light);
  light.outer = one_minus_cos(l.angle);
  light.inner = one_minus_cos(l.angle * (1 - l.softness));
  return light;
}

// About the irradiance that a light brings to the scene.
double power_of(const Light& l) {
  const double intensity = std::max({l.intensity.x, l.intensity.y, l.intensity.z});
  if (l.type == LIGHT_DIRECTIONAL || l.falloff == FALLOFF_NONE) return intensity;
  const double squared =
      double(l.position.x) * l.position.x + double(l.position.y) * l.position.y + double(l.position.z) * l.position.z;
  return intensity / std::max(1.0, squared);
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
void shares_fill(FlatScene& scene) {
  if (scene.lights.size() > LIGHTS_ENUMERATED)
    std::stable_sort(scene.lights.begin(), scene.lights.end(),
                     [](const Light& a, const Light& b) { return curve_place(a) < curve_place(b); });
  const double total = std::accumulate(scene.lights.begin(), scene.lights.end(), 0.0,
                                       [](double sum, const Light& l) { return sum + power_of(l); });
  const double count = static_cast<double>(scene.lights.size());
  double sum = 0;
  scene.light_shares.push_back(0);
  for (const Light& l : scene.lights) {
    sum += total > 0 ? 0.5 / count + 0.5 * power_of(l) / total : 1 / count;
    scene.light_shares.push_back(static_cast<float>(sum));
  }
  scene.light_shares.back() = 1;
}

}  // namespace

void flatten_lights(const SceneDesc& desc, FlatScene& scene) {
  for (const LightDesc& l : desc.lights) scene.lights.push_back(light_flatten(l, scene));
  shares_fill(scene);
}

}  // namespace brume
