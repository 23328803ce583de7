// Ear clipping in the plane of the polygon. A quad is cut along the shorter of the diagonals that lie within it.
#include "mesh/polygon.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace brume {

namespace {

using glm::dvec2;
using glm::dvec3;
using Triangles = std::vector<std::array<int, 3>>;

double cross(const dvec2& a, const dvec2& b, const dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Seen from the side from which it turns to the left; empty where it has no area.
std::vector<dvec2> project(const std::vector<dvec3>& corners) {
  dvec3 normal(0);
  for (std::size_t i = 0; i < corners.size(); ++i)
    normal += glm::cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
  if (!(glm::length(normal) > 0)) return {};
  normal = glm::normalize(normal);
  const dvec3 x = glm::normalize(glm::cross(std::abs(normal.x) < 0.9 ? dvec3(1, 0, 0) : dvec3(0, 1, 0), normal));
  const dvec3 y = glm::cross(normal, x);
  std::vector<dvec2> flat;
  flat.reserve(corners.size());
  for (const dvec3& p : corners) flat.emplace_back(glm::dot(p - corners[0], x), glm::dot(p - corners[0], y));
  return flat;
}

Triangles quad(const std::vector<dvec3>& p, const std::vector<dvec2>& flat) {
  const auto left = [&](int a, int b, int c) { return cross(flat[a], flat[b], flat[c]) > 0; };
  const bool within02 = left(0, 1, 2) && left(0, 2, 3), within13 = left(0, 1, 3) && left(1, 2, 3);
  const bool shorter02 = glm::distance(p[0], p[2]) < glm::distance(p[1], p[3]);
  if (within02 && (shorter02 || !within13)) return {{0, 1, 2}, {0, 2, 3}};
  return {{0, 1, 3}, {1, 2, 3}};
}

class Clipper {
 public:
  explicit Clipper(const std::vector<dvec2>& flat) : p_(flat), left_(static_cast<int>(flat.size())) {
    for (int i = 0; i < left_; ++i) {
      next_.push_back((i + 1) % left_);
      previous_.push_back((i + left_ - 1) % left_);
    }
    for (int i = 0; i < left_; ++i)
      if (turn(i) <= 0) blunt_.push_back(i);
  }

  Triangles run() {
    int at = 0;
    for (int refused = 0; left_ > 3;) {
      if (is_ear(at)) {
        at = clip(at);
        refused = 0;
      } else if (++refused < left_) {
        at = next_[at];
      } else {  // crosses itself, or what is left has no area
        at = clip(flattest(at));
        refused = 0;
      }
    }
    out_.push_back({previous_[at], at, next_[at]});
    return std::move(out_);
  }

 private:
  double turn(int i) const { return cross(p_[previous_[i]], p_[i], p_[next_[i]]); }

  // Only corners that do not turn left can lie in an ear.
  bool is_ear(int i) {
    if (turn(i) <= 0) return false;
    const dvec2 &a = p_[previous_[i]], &b = p_[i], &c = p_[next_[i]];
    std::size_t kept = 0;
    bool ear = true;
    for (const int k : blunt_) {
      if (next_[k] < 0 || turn(k) > 0) continue;  // clipped, or turns left by now
      blunt_[kept++] = k;
      const dvec2& q = p_[k];
      if (q == a || q == b || q == c) continue;
      if (cross(a, b, q) >= 0 && cross(b, c, q) >= 0 && cross(c, a, q) >= 0) ear = false;
    }
    blunt_.resize(kept);
    return ear;
  }

  int flattest(int start) const {
    int best = start;
    for (int i = next_[start]; i != start; i = next_[i])
      if (std::abs(turn(i)) < std::abs(turn(best))) best = i;
    return best;
  }

  // Returns a corner beyond the cut, so that the next ear is not cut from the same corner.
  int clip(int i) {
    const int a = previous_[i], c = next_[i];
    out_.push_back({a, i, c});
    next_[a] = c;
    previous_[c] = a;
    next_[i] = -1;
    --left_;
    return next_[c];
  }

  const std::vector<dvec2>& p_;
  int left_;
  std::vector<int> next_, previous_;  // of those that are left; next_ is -1 for a clipped one
  std::vector<int> blunt_;            // corners that did not turn left when last looked at
  Triangles out_;
};

}  // namespace

Triangles polygon_triangulate(const std::vector<dvec3>& corners) {
  const int n = static_cast<int>(corners.size());
  if (n == 3) return {{0, 1, 2}};
  if (n < 3) return {};
  const std::vector<dvec2> flat = project(corners);
  if (!flat.empty()) return n == 4 ? quad(corners, flat) : Clipper(flat).run();
  Triangles fan;
  for (int i = 1; i + 1 < n; ++i) fan.push_back({0, i, i + 1});
  return fan;
}

}  // namespace brume
