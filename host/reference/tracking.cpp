// See tracking.hpp. T is carried here, not τ: products of a few factors in double do not underflow before they are
// black.
#include "reference/tracking.hpp"

#include <algorithm>
#include <cmath>

#include "shared/method.h"

namespace brume::reference {
namespace {

// Parameters at which the ray passes from brick to brick.
std::vector<double> brick_crossings(const RayD& ray, const Interval& span) {
  std::vector<double> all{span.t0, span.t1};
  for (int axis = 0; axis < 3; ++axis) {
    if (ray.dir[axis] == 0) continue;
    const double a = ray.at(span.t0)[axis], b = ray.at(span.t1)[axis];
    const double last = std::floor(std::max(a, b) / BRICK_CELLS);
    for (double plane = std::ceil(std::min(a, b) / BRICK_CELLS); plane <= last; ++plane) {
      const double t = (plane * BRICK_CELLS - ray.origin[axis]) / ray.dir[axis];
      if (t > span.t0 && t < span.t1) all.push_back(t);
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

struct Range {
  double min, max;
};

Range range_at(const PlannedScene& scene, const Medium& medium, const dvec3& cell_position) {
  const int number = brick_number(scene, medium, cell_at(medium, cell_position));
  if (number == BRICK_EMPTY) return {0, 0};
  const auto at = 2 * static_cast<std::size_t>(number);
  return {scene.brick_ranges[at], scene.brick_ranges[at + 1]};
}

}  // namespace

void collisions_visit(const PlannedScene& scene, const Medium& medium, const RayD& world, const Interval& span,
                      const RandomStream& random, int method, bool only_tau,
                      const std::function<bool(const CollisionD&)>& visit) {
  if (span.empty()) return;
  const RayD ray = ray_to_cells(medium, world);
  const bool residual = method == METHOD_RESIDUAL_RATIO;
  uint id = 0;
  const auto draw = [&] { return -std::log1p(-random.at(id, RANDOM_PLACE)); };
  double optical = draw(), control = 0;  // left to the next collision; since the last one
  const std::vector<double> borders = brick_crossings(ray, span);
  for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
    const Range range = range_at(scene, medium, ray.at(0.5 * (borders[i] + borders[i + 1])));
    if (!(range.max > 0)) continue;
    const double low = residual ? range.min : 0;
    const double rate = medium.track_sigma * (range.max - (only_tau ? low : 0));
    double t = borders[i];
    while (rate * (borders[i + 1] - t) > optical) {
      const double step = optical / rate;
      t += step;
      control += low * step;
      if (!visit({t, control, 1 / rate, density_at(scene, medium, ray.at(t)), low, id})) return;
      control = 0;
      ++id;
      optical = draw();
    }
    optical -= rate * (borders[i + 1] - t);
    control += low * (borders[i + 1] - t);
  }
  if (residual) visit({span.t1, control, 0, 0, 0, id});
}

CollisionWorth collide(const CollisionD& collision, const dvec3& sigma_t, const RandomStream& random, int method,
                       dvec3& transmittance) {
  transmittance *= glm::exp(-sigma_t * collision.control);
  CollisionWorth worth{collision.density * collision.spacing, transmittance};
  const dvec3 p = glm::clamp(sigma_t * ((collision.density - collision.low) * collision.spacing), 0.0, 1.0);
  const double strongest = std::max({p.x, p.y, p.z});
  if (method != METHOD_DELTA_TRACKING || !(strongest > 0)) {
    transmittance *= 1.0 - p;
    const double asked = TRACK_LIGHTS * std::max({sigma_t.x, sigma_t.y, sigma_t.z}) * worth.weight;
    if (asked > 0 && asked < 1) worth.weight = random.at(collision.id, RANDOM_REAL) < asked ? worth.weight / asked : 0;
    return worth;
  }
  if (random.at(collision.id, RANDOM_REAL) < strongest) {
    worth.weight /= strongest;
    transmittance = dvec3(0);
  } else {
    worth.weight = 0;
    transmittance *= (1.0 - p) / (1.0 - strongest);
  }
  return worth;
}

bool roulette(double threshold, const RandomStream& random, uint id, dvec3& transmittance) {
  const double left = std::max({transmittance.x, transmittance.y, transmittance.z});
  if (!(left < threshold)) return true;
  const double survival = left / threshold;
  if (random.at(id, RANDOM_ROULETTE) < survival) {
    transmittance /= survival;
    return true;
  }
  transmittance = dvec3(0);
  return false;
}

}  // namespace brume::reference
