// The materials that an OBJ file names, out of the MTL files that it names.
#pragma once
#include <filesystem>
#include <vector>

#include "mesh/mesh.hpp"
#include "mesh/obj_parse.hpp"

namespace brume {

// Reads the libraries beside the OBJ into mesh.materials; returns for each of obj.materials its index there, -1 for
// none. A library that cannot be read and a name that none of them has are told.
std::vector<int> obj_materials(const std::filesystem::path& file, ObjFile& obj, Mesh& mesh);

}  // namespace brume
