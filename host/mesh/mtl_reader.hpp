// Material libraries (MTL).
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "mesh/text_lines.hpp"

namespace brume {

// Appends the materials of `text`, which is that of the file; one whose name is there already is told and left out. What brume does
// not show, and every line that is not understood, becomes a note. Throws InputError for numbers beyond float.
void mtl_read(const std::filesystem::path& file, std::string_view text, std::vector<MeshMaterial>& materials,
              std::vector<std::string>& notes);

// The value of a map_* line: options and the name of an image. Options that brume does not follow are told in `notes`.
MeshTexture mtl_texture(const std::filesystem::path& folder, std::string_view words, std::size_t line,
                        LineNotes& notes);

}  // namespace brume
