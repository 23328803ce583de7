// Where the instances of a mesh stand, as a text file says: 12 numbers a line, the rows of a 3x4 matrix.
#pragma once
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x3.hpp>
#include <glm/matrix.hpp>
#include <vector>

namespace brume {

// The map of a mesh to the world, p' = M (p, 1).
using MeshPlacement = glm::dmat4x3;

// More of them than kernels count.
inline constexpr std::size_t PLACEMENTS_MAX = std::size_t(1) << 24;

// Whether it keeps a volume: no axis becomes 0, nor do they come to lie in one plane, to a part in 1e9.
inline bool placement_keeps_volume(const MeshPlacement& placement) {
  glm::dmat3 axes(placement);
  for (int k = 0; k < 3; ++k) {
    const double length = glm::length(axes[k]);
    if (!(length > 0 && std::isfinite(length))) return false;
    axes[k] /= length;
  }
  return std::abs(glm::determinant(axes)) > 1e-9;
}

// "#" begins a comment, blank lines are passed over. Throws InputError for a file that is missing or holds none, and
// with its line for one that is no such matrix or keeps no volume.
std::vector<MeshPlacement> placements_read(const std::filesystem::path& file);

}  // namespace brume
