// See mesh_build.hpp.
#include "mesh/mesh_build.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "mesh/polygon.hpp"

namespace brume {

namespace {

bool has_area(const Mesh& mesh, const MeshTriangle& t) {
  const glm::dvec3 &a = mesh.positions[t.position[0]], &b = mesh.positions[t.position[1]],
                   &c = mesh.positions[t.position[2]];
  return glm::length(glm::cross(b - a, c - a)) > 0;
}

// Unit, of whatever length in double; 0 stays 0.
glm::dvec3 unit(const glm::dvec3& n) {
  const double largest = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
  return largest > 0 ? glm::normalize(n / largest) : n;
}

}  // namespace

void normals_unit(Mesh& mesh) {
  for (glm::dvec3& n : mesh.normals) n = unit(n);
}

void positions_compact(Mesh& mesh) {
  std::vector<int> index(mesh.positions.size(), -1);
  std::vector<glm::dvec3> used;
  for (MeshTriangle& t : mesh.triangles)
    for (int& position : t.position) {
      if (index[position] < 0) {
        index[position] = static_cast<int>(used.size());
        used.push_back(mesh.positions[position]);
      }
      position = index[position];
    }
  mesh.positions = std::move(used);
}

std::size_t face_add(Mesh& mesh, const std::array<int, 3>* corners, std::size_t count, int material, int group) {
  std::vector<glm::dvec3> around;
  for (std::size_t k = 0; k < count; ++k) around.push_back(mesh.positions.at(corners[k][0]));
  std::size_t dropped = 0;
  for (const std::array<int, 3>& cut : polygon_triangulate(around)) {
    MeshTriangle t;
    for (int k = 0; k < 3; ++k) {
      const auto [position, uv, normal] = corners[cut[k]];
      t.position[k] = position;
      t.normal[k] = normal >= 0 && mesh.normals.at(normal) != glm::dvec3(0) ? normal : -1;
      t.uv[k] = uv;
    }
    t.material = material;
    t.group = group;
    if (has_area(mesh, t)) {
      mesh.triangles.push_back(t);
    } else {
      ++dropped;
    }
  }
  return dropped;
}

}  // namespace brume
