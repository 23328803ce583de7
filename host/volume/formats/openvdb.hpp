// OpenVDB files: float (also saved as half), double, int32, int64, bool and mask grids, level sets. Samples sit at
// integer index. OpenVDB itself is seen by brume-volume alone.
#pragma once
#include "volume/volume_file.hpp"

namespace brume {

// See volume_file.hpp, through which these are called. Refused with an InputError that says what is allowed: other
// value types, staggered grids, transforms that are not linear, level sets that are not to be filled, backgrounds other
// than 0, values that are NaN, infinite or negative, and files that are damaged as far as that can be seen.
std::vector<VolumeGridInfo> vdb_list(const std::filesystem::path& file, bool voxels);
Grid vdb_read(const std::filesystem::path& file, const std::string& grid_name, const VolumeValues& values);
VolumeFirst vdb_read_first(const std::filesystem::path& file);

// Writes the grid as a fog volume named grid.name ("density" if empty): its non-zero samples become active voxels at
// index = lattice index, with the transform that puts them where world_from_lattice does. `half` stores 16-bit values.
// The file is complete or absent. A Border::CLAMP grid becomes one with zero around it. Throws RuntimeError.
enum class VdbPrecision { FLOAT, HALF };
void vdb_write(const Grid& grid, const std::filesystem::path& file, VdbPrecision precision = VdbPrecision::FLOAT);

}  // namespace brume
