// The lines of an OBJ file, checked, before faces are cut into triangles and materials looked up.
#pragma once
#include <array>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "mesh/text_lines.hpp"

namespace brume {

struct ObjFace {
  std::size_t first, corners;  // in ObjFile::corners; at least 3
  std::size_t line;
  int material, group;  // index into ObjFile::materials, -1 before the first usemtl; smoothing group
};

struct ObjName {
  std::string name;
  std::size_t line;
};

struct ObjFile {
  explicit ObjFile(const std::filesystem::path& file) : notes(file) {}
  std::vector<glm::dvec3> positions, normals;
  std::vector<glm::dvec2> uvs;
  std::vector<std::array<int, 3>> corners;  // indices from 0 of position, uv and normal; -1 for none
  std::vector<ObjFace> faces;
  std::vector<ObjName> materials, libraries;  // what usemtl and mtllib name, each once, at its first line
  LineNotes notes;
};

// Throws InputError "file: line N: cause" for a vertex, normal or texture coordinate that is not numbers up to 1e38,
// for a corner of a face that is not indices, or one out of range; and for a text in which no line is a vertex or a
// face.
ObjFile obj_parse(const std::filesystem::path& file);

}  // namespace brume
