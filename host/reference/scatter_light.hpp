// The light that a segment of a view ray takes and sends on, by the rule of the frame. Where segments lie is the
// business of scatter_segments.cpp.
#pragma once
#include <cmath>
#include <functional>
#include <vector>

#include "reference/lit_steps.hpp"
#include "reference/scatter.hpp"

namespace brume::reference {

inline const double FIRST_POINT = (1 - 1 / std::sqrt(3.0)) / 2;  // of two points of a segment, as a share of it
inline constexpr double DENSE_POINT = 1.0 / 16384;               // the same where a segment is dense

class LightLadder;

// A piece of a view ray through a medium for which light is asked for: at t, where it is dense at both of its ends, or
// at two points.
struct Segment {
  int medium;
  double t;
  RandomStream walk;    // of the walk that it belongs to,
  uint id;              // which number it has there,
  RandomStream random;  // and its own
  RandomStream places;  // of the ray, for lights with an area
  bool deep = false;    // asks at its ends, unless a medium is tracked
  double begin = 0, end = 0;
  dvec3 depth{0};  // of all media over it
  bool two_points = false;
  bool bends = false;                             // no medium is tracked: depths may be taken to grow evenly
  double second = 0.5;                            // share of ∫ρ about the second of them
  double inside = 0;                              // length of the ray's way through the medium
  const std::vector<LightKink>* kinks = nullptr;  // along all of it, where segments do not end at them anyway
  const LightLadder* ladder = nullptr;            // nullptr: a collision
  bool dense() const { return deep && bends; }
};

// τ of all media from a point to a light; `places` are the numbers of the view ray, `random` is that of the walk there.
dvec3 light_depth_traced(const Context& context, std::size_t light, const dvec3& point, const RandomStream& places,
                         const RandomStream& random, double& lookups);

// Where between two places, of which the first is lit as told and the other is not so, that changes.
double edge_between(const std::function<bool(double)>& lit, double near, double far, bool first);

// ∫ρT over a segment by a row of BRUME_IN_SCATTERINGS: `integral` is ∫ρ over it, `before` the optical depth up to it
// and `depth` that over it.
double gain_of(int rule, double integral, double before, double depth);

// What a medium sends to the origin of the ray from one segment: σs S + emission; and into shadow_key the lights that a
// surface keeps from where it was asked.
dvec3 sent_from(const Context& context, const Segment& at, const RayD& ray, Scattered& result);

}  // namespace brume::reference
