// See mesh_outline.hpp.
#include "flat/mesh_outline.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/mat3x3.hpp>

namespace brume {

namespace {

constexpr int OUTLINE_CELLS = 4;                         // along each axis
constexpr std::size_t EXACT_MAX = std::size_t(1) << 22;  // triangles in all places whose corners are looked at

// An outline without any slack.
std::vector<Bounds> points_of(const Mesh& mesh, const MeshPart& part) {
  std::vector<Bounds> points;
  for (std::size_t i = part.first; i < part.first + part.count; ++i)
    for (const int p : mesh.triangles[i].position) {
      points.emplace_back();
      points.back().add(mesh.positions[static_cast<std::size_t>(p)]);
    }
  return points;
}

}  // namespace

std::size_t alone_count(const Mesh& mesh) {
  return mesh.parts.empty() ? mesh.triangles.size() : mesh.parts.front().first;
}

void mesh_bounds_add(const Mesh& mesh, std::size_t first, std::size_t count, Bounds& bounds) {
  for (std::size_t i = first; i < first + count; ++i)
    for (const int p : mesh.triangles[i].position) bounds.add(mesh.positions[static_cast<std::size_t>(p)]);
}

std::vector<Bounds> outline_make(const Mesh& mesh, std::size_t first, std::size_t count) {
  Bounds all;
  mesh_bounds_add(mesh, first, count, all);
  const dvec3 cell = glm::max(all.size() / double(OUTLINE_CELLS), dvec3(1e-300));
  const auto clamped = [](double x) { return std::clamp(static_cast<int>(x), 0, OUTLINE_CELLS - 1); };
  std::vector<Bounds> cells(OUTLINE_CELLS * OUTLINE_CELLS * OUTLINE_CELLS);
  for (std::size_t i = first; i < first + count; ++i)
    for (const int index : mesh.triangles[i].position) {
      const dvec3& p = mesh.positions[static_cast<std::size_t>(index)];
      const dvec3 at = (p - all.lo) / cell;
      cells[(clamped(at.z) * OUTLINE_CELLS + clamped(at.y)) * OUTLINE_CELLS + clamped(at.x)].add(p);
    }
  cells.erase(std::remove_if(cells.begin(), cells.end(), [](const Bounds& b) { return b.empty(); }), cells.end());
  return cells;
}

Bounds outline_bounds(const std::vector<Bounds>& outline, const dmat4& m) {
  const glm::dmat3 linear(m), size(glm::abs(linear[0]), glm::abs(linear[1]), glm::abs(linear[2]));
  Bounds bounds;
  for (const Bounds& box : outline) {
    const dvec3 center = transform_point(m, box.center()), half = size * (0.5 * box.size());
    bounds.add(center - half);
    bounds.add(center + half);
  }
  return bounds;
}

Bounds mesh_bounds(const Mesh& mesh) {
  Bounds bounds;
  mesh_bounds_add(mesh, 0, alone_count(mesh), bounds);
  for (const MeshPart& part : mesh.parts) {
    const bool exact = part.count * part.placements.size() <= EXACT_MAX;
    const std::vector<Bounds> outline = exact ? points_of(mesh, part) : outline_make(mesh, part.first, part.count);
    for (const MeshPlacement& placement : part.placements) {
      const Bounds there = outline_bounds(outline, dmat4(placement));
      bounds.add(there.lo);
      bounds.add(there.hi);
    }
  }
  return bounds;
}

}  // namespace brume
