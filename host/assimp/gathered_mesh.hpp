// What a file of Assimp's holds, as mesh_protocol.hpp sends it. Private to host/assimp.
#pragma once
#include <assimp/scene.h>

#include <array>
#include <filesystem>
#include <glm/mat4x4.hpp>
#include <string>
#include <vector>

#include "mesh/mesh_protocol.hpp"
#include "mesh/placements.hpp"

namespace brume {

struct GatheredImage {
  std::string name;   // of the file; of one within this file a name for messages
  std::string bytes;  // of one within this file
};

struct GatheredMesh {
  std::vector<std::array<double, 3>> positions, normals;
  std::vector<std::array<double, 2>> uvs;
  std::vector<MeshCorner> corners;
  std::vector<MeshFace> faces;
  std::vector<MeshSurface> surfaces;
  std::vector<MeshSentPart> parts;
  std::vector<MeshPlacement> placements;
  std::vector<GatheredImage> images;
  std::vector<std::string> surface_names, notes;
};

// Every mesh where its node puts it; one of several nodes once, with their places. InputError for indices out of range.
GatheredMesh mesh_gather(const aiScene& scene, bool has_materials);

}  // namespace brume
