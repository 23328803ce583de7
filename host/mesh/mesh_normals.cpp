// Vertex normals for meshes that bring none.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "mesh/mesh.hpp"

namespace brume {

namespace {

double corner_angle(const glm::dvec3& a, const glm::dvec3& b) {
  return std::acos(std::clamp(glm::dot(glm::normalize(a), glm::normalize(b)), -1.0, 1.0));
}

}  // namespace

void mesh_complete_normals(Mesh& mesh) {
  const auto lacks = [](const MeshTriangle& t) {
    return std::any_of(t.normal.begin(), t.normal.end(), [](int n) { return n < 0; });
  };
  if (std::none_of(mesh.triangles.begin(), mesh.triangles.end(), lacks)) return;
  std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0));
  for (const MeshTriangle& t : mesh.triangles) {
    const glm::dvec3 p[3] = {mesh.positions[t.position[0]], mesh.positions[t.position[1]],
                             mesh.positions[t.position[2]]};
    const glm::dvec3 normal = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
    for (int k = 0; k < 3; ++k)
      sums[t.position[k]] += normal * corner_angle(p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
  }
  const int first = static_cast<int>(mesh.normals.size());
  for (const glm::dvec3& sum : sums) {
    const double length = glm::length(sum);
    mesh.normals.push_back(length > 0 ? sum / length
                                      : glm::dvec3(0, 1, 0));  // opposite sides cancel: any direction serves
  }
  for (MeshTriangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k)
      if (t.normal[k] < 0) t.normal[k] = first + t.position[k];
}

}  // namespace brume
