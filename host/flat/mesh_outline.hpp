// Where a mesh reaches: exactly where it stands alone, closely wherever else it is put.
#pragma once
#include <vector>

#include "flat/bounds.hpp"
#include "flat/transform.hpp"
#include "mesh/mesh.hpp"

namespace brume {

// How many of its triangles are in no part.
std::size_t alone_count(const Mesh& mesh);

// Of so many triangles from `first` on.
void mesh_bounds_add(const Mesh& mesh, std::size_t first, std::size_t count, Bounds& bounds);

// Boxes about all their vertices, from cells of the box about them: turned, together they stay tighter than that.
std::vector<Bounds> outline_make(const Mesh& mesh, std::size_t first, std::size_t count);
// The box about those boxes, transformed.
Bounds outline_bounds(const std::vector<Bounds>& outline, const dmat4& m);

// Of a mesh with its parts where they stand; exact but for more than four million triangles.
Bounds mesh_bounds(const Mesh& mesh);

}  // namespace brume
