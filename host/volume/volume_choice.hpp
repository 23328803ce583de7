// Which grid of a file is meant. Private to host/volume.
#pragma once
#include "volume/volume_file.hpp"
#include "volume/volume_program.hpp"

namespace brume {

// Why a grid can never be a density, by its type, class and transform; "" if it can.
std::string volume_refusal(const VolumeProgram::GridHead& grid, const VolumeValues& values);

// The number of the grid of that name, or the one that volume_read() takes without one. InputError, naming what there
// is.
std::size_t volume_find(const VolumeProgram& program, const std::string& file, const std::string& name,
                        const VolumeValues& values);

// Those that may be taken where nobody can be asked, the likeliest first. InputError where there is none.
std::vector<std::size_t> volume_candidates(const VolumeProgram& program, const std::string& file);

// "'a' (float, unknown), 'b' (...) and 12 more"
std::string volume_listing(const VolumeProgram& program);

}  // namespace brume
