// Axis-aligned box of points, in double.
#pragma once
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <limits>

namespace brume {

struct Bounds {
  glm::dvec3 lo{std::numeric_limits<double>::infinity()}, hi{-std::numeric_limits<double>::infinity()};

  void add(const glm::dvec3& p) {
    lo = glm::min(lo, p);
    hi = glm::max(hi, p);
  }
  bool empty() const { return lo.x > hi.x; }
  glm::dvec3 center() const { return 0.5 * (lo + hi); }
  glm::dvec3 size() const { return hi - lo; }
  double longest_side() const { return glm::max(size().x, glm::max(size().y, size().z)); }
  glm::dvec3 corner(int i) const { return {i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z}; }
};

}  // namespace brume
