// Vertex normals for meshes that bring none: corners are joined into sets, each of which has one normal.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include "mesh/mesh.hpp"

namespace brume {

namespace {

using glm::dvec3;

constexpr double ANGLE_ROUNDING = 1e-3;      // degrees: a right angle of a file's decimals is one
constexpr std::size_t EDGE_SHARED_MAX = 32;  // triangles; more share an edge by mistake only

double corner_angle(const dvec3& a, const dvec3& b) {
  return std::acos(std::clamp(glm::dot(glm::normalize(a), glm::normalize(b)), -1.0, 1.0));
}

// Sets of corners, whose numbers are 3 * triangle + k; a set is known by one of them.
class Corners {
 public:
  Corners(const Mesh& mesh, std::optional<double> crease) : mesh_(mesh), parent_(3 * mesh.triangles.size()) {
    std::iota(parent_.begin(), parent_.end(), 0);
    for (const MeshTriangle& t : mesh.triangles) {
      const dvec3& p = mesh.positions[t.position[0]];
      normals_.push_back(
          glm::normalize(glm::cross(mesh.positions[t.position[1]] - p, mesh.positions[t.position[2]] - p)));
    }
    crease ? join_edges(std::cos(glm::radians(std::min(*crease + ANGLE_ROUNDING, 180.0)))) : join_positions();
  }

  std::size_t set(std::size_t corner) {
    while (parent_[corner] != corner) corner = parent_[corner] = parent_[parent_[corner]];
    return corner;
  }
  const dvec3& face_normal(std::size_t triangle) const { return normals_[triangle]; }

 private:
  void join(std::size_t a, std::size_t b) { parent_[set(a)] = set(b); }

  // All corners of one position and group.
  void join_positions() {
    std::unordered_map<std::uint64_t, std::size_t> first;
    first.reserve(mesh_.positions.size());
    for (std::size_t corner = 0; corner < parent_.size(); ++corner) {
      const MeshTriangle& t = mesh_.triangles[corner / 3];
      if (t.group == GROUP_FLAT) continue;
      const auto key = static_cast<std::uint64_t>(t.position[corner % 3]) << 32 | static_cast<std::uint32_t>(t.group);
      join(corner, first.emplace(key, corner).first->second);
    }
  }

  struct Edge {
    std::array<int, 3> key;  // group and both positions, the smaller first
    std::size_t low, high;   // corners there
    bool operator<(const Edge& other) const { return std::tie(key, low) < std::tie(other.key, other.low); }
  };
  std::vector<Edge> edges() const {
    std::vector<Edge> out;
    for (std::size_t corner = 0; corner < parent_.size(); ++corner) {
      const MeshTriangle& t = mesh_.triangles[corner / 3];
      const std::size_t next = corner / 3 * 3 + (corner + 1) % 3;
      const int a = t.position[corner % 3], b = t.position[next % 3];
      if (t.group == GROUP_FLAT) continue;
      out.push_back(a < b ? Edge{{t.group, a, b}, corner, next} : Edge{{t.group, b, a}, next, corner});
    }
    std::sort(out.begin(), out.end());
    return out;
  }

  // The corners at both ends of each edge that two triangles of one group share at an angle whose cosine is at least
  // `cosine`.
  void join_edges(double cosine) {
    const std::vector<Edge> all = edges();
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t j = i + 1; j < std::min(all.size(), i + EDGE_SHARED_MAX) && all[j].key == all[i].key; ++j) {
        if (glm::dot(normals_[all[i].low / 3], normals_[all[j].low / 3]) < cosine) continue;
        join(all[i].low, all[j].low);
        join(all[i].high, all[j].high);
      }
  }

  const Mesh& mesh_;
  std::vector<std::size_t> parent_;
  std::vector<dvec3> normals_;
};

}  // namespace

void mesh_complete_normals(Mesh& mesh, std::optional<double> crease) {
  const auto lacks = [](const MeshTriangle& t) {
    return std::any_of(t.normal.begin(), t.normal.end(), [](int n) { return n < 0; });
  };
  if (std::none_of(mesh.triangles.begin(), mesh.triangles.end(), lacks)) return;
  Corners corners(mesh, crease);
  std::vector<dvec3> sums(3 * mesh.triangles.size(), dvec3(0));  // of each set, at its first corner
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const MeshTriangle& t = mesh.triangles[i / 3];
    const auto point = [&](std::size_t k) { return mesh.positions[t.position[k % 3]]; };
    sums[corners.set(i)] += corners.face_normal(i / 3) * corner_angle(point(i + 1) - point(i), point(i + 2) - point(i));
  }
  std::vector<int> index(sums.size(), -1);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    int& normal = mesh.triangles[i / 3].normal[i % 3];
    if (normal >= 0) continue;
    const std::size_t set = corners.set(i);
    if (index[set] < 0) {
      const double length = glm::length(sums[set]);
      index[set] = static_cast<int>(mesh.normals.size());
      mesh.normals.push_back(length > 0 ? sums[set] / length : corners.face_normal(i / 3));  // 0: opposite sides cancel
    }
    normal = index[set];
  }
}

}  // namespace brume
