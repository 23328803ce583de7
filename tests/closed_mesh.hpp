// A closed mesh around the origin, every edge of which two triangles share to the bit: an icosahedron, its triangles
// parted in four over and over, each corner moved in and out at random.
#pragma once
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "base/number_text.hpp"
#include "scene/scene_desc.hpp"

namespace brume::test {

struct ClosedMesh {
  std::vector<dvec3> corners;
  std::vector<std::array<int, 3>> triangles;

  std::string obj() const {
    std::string text;
    for (const dvec3& p : corners)
      text += "v " + number_text(p.x, 9) + " " + number_text(p.y, 9) + " " + number_text(p.z, 9) + "\n";
    for (const auto& t : triangles)
      text += "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " + std::to_string(t[2] + 1) + "\n";
    return text;
  }
};

inline ClosedMesh icosahedron() {
  const double g = (1 + std::sqrt(5.0)) / 2;
  return {{{-1, g, 0},
           {1, g, 0},
           {-1, -g, 0},
           {1, -g, 0},
           {0, -1, g},
           {0, 1, g},
           {0, -1, -g},
           {0, 1, -g},
           {g, 0, -1},
           {g, 0, 1},
           {-g, 0, -1},
           {-g, 0, 1}},
          {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
           {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
           {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
}

// 20 · 4^levels triangles, corners at distances of 1 ± roughness.
inline ClosedMesh closed_mesh(int levels, double roughness) {
  ClosedMesh mesh = icosahedron();
  for (int level = 0; level < levels; ++level) {
    std::map<std::array<int, 2>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [at, made] = middles.try_emplace({std::min(a, b), std::max(a, b)}, int(mesh.corners.size()));
      if (made) mesh.corners.push_back(glm::normalize(mesh.corners[a]) + glm::normalize(mesh.corners[b]));
      return at->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
  }
  std::mt19937 random(5);
  std::uniform_real_distribution<double> radius(1 - roughness, 1 + roughness);
  for (dvec3& p : mesh.corners) p = radius(random) * glm::normalize(p);
  return mesh;
}

}  // namespace brume::test
