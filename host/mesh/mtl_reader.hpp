// Material libraries (MTL).
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "mesh/file_find.hpp"
#include "mesh/mesh.hpp"
#include "mesh/text_lines.hpp"

namespace brume {

// Appends the materials of `text`, which is that of the file; one whose name is there already is told and left out.
// What brume does not show, and every line that is not understood, becomes a note. Throws InputError for numbers beyond
// float.
void mtl_read(const std::filesystem::path& file, std::string_view text, FileFinder& images,
              std::vector<MeshMaterial>& materials, std::vector<std::string>& notes);

// The value of a map_* line: options and the name of an image; without a file where there is none. What is not followed
// is told.
MeshTexture mtl_texture(FileFinder& images, std::string_view words, std::size_t line, LineNotes& notes);

}  // namespace brume
