// Depths to the lights where several media that scatter stand on one spot (PICTURE, Media on one spot): known at evenly
// spaced places of a view ray, in between by the cubic through the four about it.
#pragma once
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "reference/scatter_light.hpp"

namespace brume::reference {

class LightLadder {
 public:
  // Along a view ray up to t_max.
  LightLadder(const Context& context, const RayD& ray, double t_max);

  // τ of all media from the place t of a segment to a light; nothing where the segment asks for itself.
  std::optional<dvec3> depth(const Segment& at, std::size_t light, double t, double& lookups) const;

 private:
  bool holds(const Segment& at) const;
  bool is_near(const Light& light, double t) const;
  dvec3 rung(std::size_t light, long number, const Segment& at, double& lookups) const;

  const Context& context_;
  RayD ray_;
  double begin_ = 0, step_ = 0;  // of rung 0; to the next; step 0: there is no ladder
  std::vector<Interval> media_;  // ways through those that take depths from it
  mutable std::map<std::pair<std::size_t, long>, dvec3> rungs_;
};

}  // namespace brume::reference
