// Volume files: which formats there are, what a file holds, and one grid of it as a Grid.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "volume/grid.hpp"

namespace brume {

// One grid of a file, found without reading its voxels.
struct VolumeGridInfo {
  std::string name;        // by which it can be asked for; "density[1]" where several share a name
  std::string type;        // of its values: "float", "double", "vec3s", ...
  std::string grid_class;  // "fog volume", "unknown", "level set", "staggered"
  std::uint64_t active_voxels = 0;
  ivec3 index_min{0}, index_max{-1};  // inclusive box of the active voxels; min > max where there are none
  dvec3 voxel_size{0};                // world units, at the middle for transforms that are not linear
  std::string background;
  std::string refusal;  // why it cannot be a density; empty where it can
  bool can_be_density() const { return refusal.empty(); }
};

// The grids of a file in its order. Throws InputError for files that cannot be read.
std::vector<VolumeGridInfo> volume_list(const std::filesystem::path& file);

// One grid as density. An empty name takes "density" where that can be a density, else the first grid that can.
// Border::ZERO; lattice [0, size] is the box of the active voxels; name and source are set. Throws InputError.
Grid volume_read(const std::filesystem::path& file, const std::string& grid_name = {});

}  // namespace brume
