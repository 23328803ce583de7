// Depth of the media beside one along a view ray (PICTURE, Several media).
#pragma once
#include <algorithm>
#include <vector>

#include "reference/scatter.hpp"
#include "shared/method.h"

namespace brume::reference {

// τ of the other media along a view ray where a medium is tracked: an estimate from one asked place to the next.
struct Others {
  const Context& context;
  int medium;
  const RayD& ray;
  double t = 0;
  dvec3 tau{0};

  const dvec3& advance(double to, const RandomStream& random, double& lookups) {
    if (to > t) tau += media_tau_beside(context, medium, {ray.at(t), ray.dir}, to - t, random, lookups);
    t = std::max(t, to);
    return tau;
  }
};

// τ of one medium from the origin of a view ray to any t: it is walked once, by its own method.
class DepthAlong {
 public:
  DepthAlong(const Context& context, int index, const RayD& ray, double t_max, const RandomStream& walk,
             double& lookups)
      : scene_(context.scene), medium_(context.media[static_cast<std::size_t>(index)]), ray_(ray) {
    gauss2_ = method_rule(context.method(medium_)) == RULE_GAUSS2;
    segments_ = segments(scene_, index, ray, 0, t_max, context.method(medium_), walk);
    for (const SegmentD& segment : segments_) before_.push_back(before_.back() + segment.density_length);
    lookups += static_cast<double>(segments_.size()) * segment_lookups(medium_, context.method(medium_));
  }

  dvec3 to(double t) const {
    const auto next = std::partition_point(segments_.begin(), segments_.end(),
                                           [t](const SegmentD& segment) { return segment.t_begin < t; });
    if (next == segments_.begin()) return dvec3(0);
    const auto before = before_[static_cast<std::size_t>(next - segments_.begin()) - 1];
    return sigma_t_of(medium_) * (before + inside(*std::prev(next), t));
  }

 private:
  // ∫ρ from where a segment begins to t: as its rule knows the density there, exactly or evenly.
  double inside(SegmentD segment, double t) const {
    if (t >= segment.t_end) return segment.density_length;
    if (!gauss2_) return segment.density_length * (t - segment.t_begin) / (segment.t_end - segment.t_begin);
    segment.t_end = t;
    return density_length_gauss2(scene_, medium_, ray_, segment);
  }

  const PlannedScene& scene_;
  const Medium& medium_;
  RayD ray_;
  bool gauss2_;
  std::vector<SegmentD> segments_;
  std::vector<double> before_{0};  // ∫ρ up to each
};

}  // namespace brume::reference
