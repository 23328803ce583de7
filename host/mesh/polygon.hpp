// Polygons → triangles.
#pragma once
#include <array>
#include <glm/vec3.hpp>
#include <vector>

namespace brume {

// Triangles that cover a simple polygon once and turn as it does: always size - 2, as indices into `corners`, which go
// round it. A polygon that crosses itself or is far from flat is cut into as many, which may overlap. Fewer than 3
// corners: none.
std::vector<std::array<int, 3>> polygon_triangulate(const std::vector<glm::dvec3>& corners);

}  // namespace brume
