// OpenVDB files: float (also saved as half), double, int32 and int64 grids. Samples sit at integer index.
// No OpenVDB header is seen through this one.
#pragma once
#include "volume/volume_file.hpp"

namespace brume {

// See volume_file.hpp, through which these are called. Refused with an InputError that says what is allowed: other value
// types, level sets, staggered grids, transforms that are not linear, backgrounds other than 0, grids without an active
// voxel, values that are NaN, infinite or negative, and files that are damaged as far as that can be seen.
std::vector<VolumeGridInfo> vdb_list(const std::filesystem::path& file);
Grid vdb_read(const std::filesystem::path& file, const std::string& grid_name);

// Writes the grid as a fog volume named grid.name ("density" if empty): its non-zero samples become active voxels at
// index = lattice index, with the transform that puts them where world_from_lattice does. `half` stores 16-bit values.
// The file is complete or absent. A Border::CLAMP grid becomes one with zero around it. Throws RuntimeError.
enum class VdbPrecision { FLOAT, HALF };
void vdb_write(const Grid& grid, const std::filesystem::path& file, VdbPrecision precision = VdbPrecision::FLOAT);

}  // namespace brume
