// Volume files: which formats there are, what a file holds, and one grid of it as a Grid. They are opened by a program
// of their own, brume-volume, whose memory is bounded by the file's size: what a damaged file does to it ends there.
#pragma once
#include <filesystem>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "volume/grid.hpp"

namespace brume {

using glm::dvec2;

// How the values of a grid become densities, in this order. What is not active is 0, whatever value it holds.
struct VolumeValues {
  bool fill = false;                // a signed distance d (a level set) becomes ½ - d/voxel within [0, 1]: 1 inside
  std::optional<double> threshold;  // values below it are 0, and stay it
  std::vector<dvec2> remap;         // (value, density), value ascending: linear between them, constant beyond the ends
  double scale = 1;                 // times that
  bool clamp_negative =
      true;  // densities down to -1e-5 of the largest are rounding and become 0; else they are refused
};

// One grid of a file.
struct VolumeGridInfo {
  std::string name;        // by which it can be asked for; "density[1]" where several share a name
  std::string type;        // of its values: "float", "double", "vec3s", ...
  std::string grid_class;  // "fog volume", "unknown", "level set", "staggered"
  std::uint64_t active_voxels = 0;
  ivec3 index_min{0}, index_max{-1};  // inclusive box of the active voxels; min > max where there are none
  dvec3 voxel_size{0};                // world units, at the middle for transforms that are not linear
  std::string background;
  std::string refusal;  // why it cannot be a density by default values; empty where it can
  bool can_be_density() const { return refusal.empty(); }
  std::optional<GridStats> density;  // where voxels were asked for and it can be one
  std::vector<std::string> notes;    // as Grid::notes
};

// The endings of the files that are read: ".vdb".
std::vector<std::string> volume_endings();

// The grids of a file in its order, `voxels`: read whole, so that nothing is left that could refuse them. Throws
// InputError for files that cannot be read.
std::vector<VolumeGridInfo> volume_list(const std::filesystem::path& file, bool voxels = false);

// One grid as density. An empty name takes `density`, else the one that is so called in another case, else the only one
// of floating values, else the only one that can be a density; with several the InputError names them.
// Border::ZERO; lattice [0, size] is the box of the active voxels, one voxel of 0 where there are none; name, source
// and notes are set. Throws InputError.
Grid volume_read(const std::filesystem::path& file, const std::string& grid_name = {}, const VolumeValues& values = {});

// The same where nobody can be asked: several candidates are tried in the order above, level sets (filled) last.
struct VolumeFirst {
  Grid grid;
  bool fill;        // it is a level set
  std::string why;  // " of 'a' (float, unknown), 'b' ..." where there is more than one
};
VolumeFirst volume_read_first(const std::filesystem::path& file);

}  // namespace brume
