// From what a file says to a Mesh: for the readers of all formats. Private to host/mesh.
#pragma once
#include <array>
#include <cstddef>

#include "mesh/mesh.hpp"

namespace brume {

// All normals unit, whatever their length in double; 0 stays 0.
void normals_unit(Mesh& mesh);

// Adds the triangles of one polygon, whose corners are indices of position, uv and normal, -1 for none. Returns how
// many have no area and are left out.
std::size_t face_add(Mesh& mesh, const std::array<int, 3>* corners, std::size_t count, int material, int group);

// Positions that no triangle has go: a stray one far away must not count to the size of the mesh.
void positions_compact(Mesh& mesh);

}  // namespace brume
