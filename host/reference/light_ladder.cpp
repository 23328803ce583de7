// See light_ladder.hpp.
#include "reference/light_ladder.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "shared/method.h"

namespace brume::reference {
namespace {

constexpr double RUNGS_PER_CELL = 2;
constexpr std::size_t MEDIA_LEAST = 2;
constexpr double DEPTH_MOST = 0.25;      // from rung to rung
constexpr double BEND_MOST = 1.0 / 512;  // of the cubic from a straight line, as a share of 1 + that
constexpr double LAMP_LEAST = 8;         // rungs to a lamp

// Lagrange's polynomial through values at -1, 0, 1 and 2.
dvec3 cubic(const dvec3 (&values)[4], double u) {
  dvec3 sum(0);
  for (int i = 0; i < 4; ++i) {
    double weight = 1;
    for (int j = 0; j < 4; ++j)
      if (j != i) weight *= (u - (j - 1)) / (i - j);
    sum += weight * values[i];
  }
  return sum;
}

}  // namespace

LightLadder::LightLadder(const Context& context, const RayD& ray, double t_max) : context_(context), ray_(ray) {
  if (!context.scene.frame.light_ladder) return;
  double cells = 0;
  for (const Medium& medium : context.media) {
    const bool scatters = vec_promote(medium.sigma_s) != dvec3(0);
    if (method_placement(context.method(medium)) != PLACEMENT_CELLS || medium.light_grids >= 0 || !scatters) continue;
    const Interval way = medium_interval(medium, ray, 0, t_max);
    if (!(way.t1 > way.t0)) continue;
    begin_ = media_.empty() ? way.t0 : std::min(begin_, way.t0);
    media_.push_back(way);
    cells = std::max(cells, glm::length(ray_to_cells(medium, ray).dir));
  }
  if (media_.size() >= MEDIA_LEAST) step_ = 1 / (RUNGS_PER_CELL * cells);
}

bool LightLadder::holds(const Segment& at) const {
  const double middle = (at.begin + at.end) / 2;
  const auto media = std::count_if(media_.begin(), media_.end(),
                                   [&](const Interval& way) { return way.t0 <= middle && middle <= way.t1; });
  const double depth = std::max({at.depth.x, at.depth.y, at.depth.z});
  return media >= static_cast<long>(MEDIA_LEAST) && depth * step_ <= DEPTH_MOST * (at.end - at.begin);
}

bool LightLadder::is_near(const Light& light, double t) const {
  return light.type != LIGHT_DIRECTIONAL &&
         glm::distance(vec_promote(light.position), ray_.at(t)) <= LAMP_LEAST * step_;
}

dvec3 LightLadder::rung(std::size_t light, long number, const Segment& at, double& lookups) const {
  const auto [known, is_new] = rungs_.try_emplace({light, number}, 0);
  if (!is_new) return known->second;
  const dvec3 point = ray_.at(begin_ + static_cast<double>(number) * step_);
  return known->second = light_depth_traced(context_, light, point, at.places, at.walk, lookups);
}

std::optional<dvec3> LightLadder::depth(const Segment& at, std::size_t light, double t, double& lookups) const {
  if (!(step_ > 0) || is_near(context_.scene.lights[light], t) || !holds(at)) return {};
  const double along = (t - begin_) / step_;
  const long number = std::lround(std::floor(along));
  dvec3 tau[4];
  for (int i = 0; i < 4; ++i) tau[i] = rung(light, number + i - 1, at, lookups);
  const double u = along - static_cast<double>(number);
  const dvec3 depth = cubic(tau, u), line = glm::mix(tau[1], tau[2], u);
  for (int c = 0; c < 3; ++c)
    if (std::abs(depth[c] - line[c]) > BEND_MOST * (1 + line[c])) return {};
  return glm::max(depth, 0.0);
}

}  // namespace brume::reference
