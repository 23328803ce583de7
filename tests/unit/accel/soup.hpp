// Triangles without order and readers of flat arrays, for the tests of the BVH.
#pragma once
#include <algorithm>
#include <array>
#include <cstring>
#include <random>
#include <vector>

#include "accel/bvh.hpp"
#include "base/float_bits.hpp"

namespace brume {

using Soup = std::vector<Triangle>;
using Point = std::array<float, 3>;

inline Triangle triangle(const Point& a, const Point& b, const Point& c) {
  Triangle t{};
  t.p[0] = {a[0], a[1], a[2]};
  t.p[1] = {b[0], b[1], b[2]};
  t.p[2] = {c[0], c[1], c[2]};
  return t;
}

// Triangles of one size class somewhere in a cube.
inline Soup random_soup(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(-10, 10), reach(-1, 1);
  Soup soup;
  for (int i = 0; i < count; ++i) {
    Point p[3];
    const Point at{place(random), place(random), place(random)};
    for (Point& corner : p)
      for (int axis = 0; axis < 3; ++axis) corner[axis] = at[axis] + reach(random);
    soup.push_back(triangle(p[0], p[1], p[2]));
  }
  return soup;
}

inline std::vector<BvhBox> boxes_of(const Soup& soup) {
  std::vector<BvhBox> boxes;
  for (const Triangle& t : soup) {
    BvhBox box;
    for (int axis = 0; axis < 3; ++axis) {
      const float p[3] = {(&t.p[0].x)[axis], (&t.p[1].x)[axis], (&t.p[2].x)[axis]};
      box.lo[axis] = *std::min_element(p, p + 3);
      box.hi[axis] = *std::max_element(p, p + 3);
    }
    boxes.push_back(box);
  }
  return boxes;
}

// Of floats that are numbers of nodes and triangles too.
inline bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

// The last run of each record: links of nodes, ids of blocks.
inline std::vector<int> last_runs(const std::vector<float>& records, int runs, int width) {
  std::vector<int> out;
  for (std::size_t i = 0; i < records.size(); ++i)
    if (static_cast<int>(i) / width % runs == runs - 1) out.push_back(float_as_bits(records[i]));
  return out;
}

}  // namespace brume
