// See ray_moves.hpp.
#include "check/ray_moves.hpp"

#include <algorithm>
#include <cmath>

namespace brume {

namespace {

constexpr double DIGITS = 0x1p-21;  // four of float's

bool has_nan(const std::vector<double>& values) {
  return std::any_of(values.begin(), values.end(), [](double v) { return std::isnan(v); });
}

}  // namespace

reference::RayD ray_moved(const reference::RayD& ray, int move) {
  reference::RayD moved = ray;
  glm::dvec3& v = move < RAY_MOVES / 2 ? moved.origin : moved.dir;
  const double size = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  v[move / 2 % 3] += (move % 2 ? DIGITS : -DIGITS) * size;
  return moved;
}

void add_or_edge(ErrorSum& sum, const std::vector<double>& kernel, const std::vector<double>& reference,
                 const std::function<std::vector<double>(int move)>& moved) {
  if (!sum.agree(kernel, reference) && !has_nan(kernel) && !has_nan(reference))
    for (int move = 0; move < RAY_MOVES; ++move)
      if (!sum.agree(moved(move), reference)) {
        sum.add_edge();
        return;
      }
  for (std::size_t i = 0; i < kernel.size(); ++i) sum.add(kernel[i], reference[i]);
}

}  // namespace brume
