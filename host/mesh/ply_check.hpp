// Whether a PLY file is as long as its header promises: its reader would take what is missing for 0, or make room for
// it. Private to host/mesh.
#pragma once
#include <filesystem>

namespace brume {

// InputError "file: cause". What is odd otherwise is left to the reader.
void ply_check(const std::filesystem::path& file);

}  // namespace brume
