// A triangle mesh as its OBJ file states it, checked: every index is in range, every position finite, no triangle without area.
#pragma once
#include <array>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace brume {

struct MeshMaterial {
  std::string name;
  glm::dvec3 diffuse{0.5}, specular{0}, ambient{0}, emission{0};
  double shininess = 50;
  std::filesystem::path texture;  // map_Kd, resolved; empty for none
};

struct MeshTriangle {
  std::array<int, 3> position, normal, uv;  // indices; normal and uv are -1 where the file gives none
  int material = -1;                        // index into Mesh::materials, -1 for none
};

struct Mesh {
  std::vector<glm::dvec3> positions, normals;  // normals are unit
  std::vector<glm::dvec2> uvs;
  std::vector<MeshTriangle> triangles;
  std::vector<MeshMaterial> materials;
  std::vector<std::string> notes;  // what a user should be told: missing MTL, dropped triangles, ...
};

// Throws InputError for a file that is missing, has no triangle, an index out of range, a NaN vertex, or syntax that the parser
// would only guess at.
Mesh mesh_read_obj(const std::filesystem::path& file);

// Gives every corner without a normal one: the angle-weighted mean over the triangles that share its position [Thuermer98].
void mesh_complete_normals(Mesh& mesh);

}  // namespace brume
