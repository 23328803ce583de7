// A mesh as brume-mesh sends it (mesh_protocol.hpp). Private to host/mesh.
#pragma once
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "mesh/mesh_protocol.hpp"
#include "mesh/placements.hpp"

namespace brume {

struct SentMesh {
  std::vector<glm::dvec3> positions, normals;
  std::vector<glm::dvec2> uvs;
  std::vector<MeshCorner> corners;
  std::vector<MeshFace> faces;
  std::vector<MeshSurface> surfaces;
  std::vector<MeshSentPart> parts;
  std::vector<MeshPlacement> placements;
  std::vector<std::uint64_t> image_sizes;
  std::string image_bytes;
  std::vector<std::string> texts;
};

// Starts the program and asks it for the file. Nothing of what it sends is checked but its size. InputError "file: ..."
// for files that cannot be read, or that make the program crash; Interrupted on Ctrl-C.
SentMesh mesh_ask(const std::filesystem::path& file);

}  // namespace brume
