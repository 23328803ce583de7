// Tentative collisions along a ray [Woodcock65] [Novak14]: at a rate from each brick's own range of densities.
#pragma once
#include <functional>

#include "reference/medium.hpp"
#include "reference/random.hpp"

namespace brume::reference {

struct CollisionD {
  double t;             // world distance along the ray
  double control;       // ∫ of the bricks' lower bounds since the last collision (residual ratio; else 0)
  double spacing;       // mean distance between collisions here; 0 for the end of the ray, which is no collision
  double density, low;  // at t, and the brick's lower bound
  uint id;              // number of the collision
};

// Calls visit(collision) from front to back until it returns false. only_tau: collisions are needed only for what
// exceeds the lower bounds.
void collisions_visit(const PlannedScene& scene, const Medium& medium, const RayD& world, const Interval& span,
                      const RandomStream& random, int method, bool only_tau,
                      const std::function<bool(const CollisionD&)>& visit);

// T = exp(-τ) up to a channel each; what a collision does to them and what it is worth.
//   weight: estimate of ∫ρ at the collision, 0 where no light is asked for; before: T up to it
struct CollisionWorth {
  double weight;
  dvec3 before;
};
CollisionWorth collide(const CollisionD& collision, const dvec3& sigma_t, const RandomStream& random, int method,
                       dvec3& transmittance);

// Russian roulette, by the largest channel of T: where it is below the threshold, the ray goes on with probability
// T / threshold and all channels grow so that the largest is the threshold; else they become 0. False: the ray ended.
bool roulette(double threshold, const RandomStream& random, uint id, dvec3& transmittance);

}  // namespace brume::reference
