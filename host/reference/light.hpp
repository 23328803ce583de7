// What a light would send to a point if nothing stood in between.
#pragma once
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "plan/render_plan.hpp"
#include "reference/random.hpp"
#include "reference/vec.hpp"
#include "shared/light.h"

namespace brume::reference {

struct LightSample {
  dvec3 travel{0};      // unit direction in which the light travels at the point
  dvec3 irradiance{0};  // E at normal incidence
  double distance = 0;  // to the light; infinite for a directional one
  double reach = 0;     // surfaces nearer than this block it: one that is a light is none of them itself
  // Of the point whose normal that is, but for what it was rounded by.
  bool in_plane(const dvec3& normal, double epsilon) const {
    return std::abs(distance * glm::dot(normal, travel)) <= epsilon;
  }
  bool shines() const { return irradiance.x > 0 || irradiance.y > 0 || irradiance.z > 0; }
};

// Which lights a point asks, each with what its light counts: all, or some chosen (FlatScene::light_shares). random: of
// the ray or walk, n: the number of the segment, 0 for a surface. `all`: none are chosen.
struct LightPick {
  std::size_t light;
  double weight;
};
std::vector<LightPick> light_picks(const PlannedScene& scene, const RandomStream& random, uint n, bool all = false);

// At the very position of a point or spot light there is no direction: E is 0 there. random: of the ray, says which
// place of a surface that emits is asked.
LightSample light_at(const PlannedScene& scene, const Light& light, const dvec3& point, const RandomStream& random);

}  // namespace brume::reference
