// Doubles out of the float structs of kernels/shared, and the ray of the reference renderer. Everything that the
// reference computes is double: floats are promoted here, and directions stored as floats are made unit again.
#pragma once
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>

#include "shared/platform.h"

namespace brume::reference {

using glm::dvec2;
using glm::dvec3;
using glm::ivec3;

inline constexpr double INFINITE = std::numeric_limits<double>::infinity();
inline constexpr double PI = 3.14159265358979323846264338327950288;

inline dvec3 vec_promote(const Packed3& p) { return {p.x, p.y, p.z}; }
inline dvec3 vec_promote(const float* p) { return {p[0], p[1], p[2]}; }
inline dvec3 vec_unit(const dvec3& v) { return v / glm::length(v); }

// A normal, or a gradient, of the space that the map leads to, in the one it comes from: by its transpose.
inline dvec3 affine_normal(const Affine& a, const dvec3& n) {
  return n.x * vec_promote(a.m) + n.y * vec_promote(a.m + 4) + n.z * vec_promote(a.m + 8);
}

// Two unit vectors at right angles to a third and to each other [Duff17, listing 3].
inline std::array<dvec3, 2> vec_beside(const dvec3& n) {
  const double sign = std::copysign(1.0, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
  return {dvec3(1 + sign * n.x * n.x * a, sign * b, -sign * n.x), dvec3(b, sign + n.y * n.y * a, -n.y)};
}

inline dvec3 affine_direction(const Affine& a, const dvec3& d) {
  return {glm::dot(vec_promote(a.m), d), glm::dot(vec_promote(a.m + 4), d), glm::dot(vec_promote(a.m + 8), d)};
}
inline dvec3 affine_point(const Affine& a, const dvec3& p) {
  return affine_direction(a, p) + dvec3(a.m[3], a.m[7], a.m[11]);
}

// `dir` is unit in world space; a ray carried into another space keeps its t and so need not be unit there.
struct RayD {
  dvec3 origin{0};
  dvec3 dir{0, 0, -1};
  dvec3 at(double t) const { return origin + t * dir; }
};

}  // namespace brume::reference
