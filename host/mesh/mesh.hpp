// A triangle mesh as its file states it, checked: every index is in range, every position finite, no triangle
// without area.
#pragma once
#include <array>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/memory_file.hpp"
#include "mesh/placements.hpp"

namespace brume {

enum class MeshWrap { REPEAT, CLAMP, MIRROR, ONCE };  // beside an image; ONCE: 1

// base + gain * the image at scale * uv + offset.
struct MeshTexture {
  std::filesystem::path file;  // resolved; empty for none
  std::string name{};          // for messages, where the image lies in the mesh's own file
  glm::dvec2 scale{1}, offset{0};
  double base = 0, gain = 1;
  MeshWrap wrap = MeshWrap::REPEAT;
};

struct MeshMaterial {
  std::string name;
  glm::dvec3 diffuse{0.5}, specular{0}, ambient{0}, emission{0};
  double shininess = 50, reflection = 0, refraction = 0, ior = 1.5;
  MeshTexture texture, emission_texture;  // times diffuse, times emission
};

constexpr int GROUP_ALL = -1;  // of a face that no smoothing group was said for
constexpr int GROUP_FLAT = 0;  // "s off"

struct MeshTriangle {
  std::array<int, 3> position, normal, uv;  // indices; normal and uv are -1 where the file gives none
  int material = -1;                        // index into Mesh::materials, -1 for none
  int group = GROUP_ALL;                    // smoothing group; normals are joined within one only
};

// Triangles that stand in several places.
struct MeshPart {
  std::size_t first, count;  // of Mesh::triangles
  std::vector<MeshPlacement> placements;
};

struct Mesh {
  std::vector<glm::dvec3> positions, normals;  // positions: those that triangles have; normals: unit, or 0 where unused
  std::vector<glm::dvec2> uvs;
  std::vector<MeshTriangle> triangles;
  std::vector<MeshPart> parts;  // the last triangles, one part behind the other; those before stand where they are
  std::vector<MeshMaterial> materials;
  std::vector<std::shared_ptr<const MemoryFile>> images;  // that lie in the mesh's own file; textures name them
  std::vector<std::string>
      notes;  // what a user should be told: missing MTL, dropped triangles, lines that are not read, ...
};

// Throws InputError for a file that is missing, has no triangle, an index out of range, a vertex beyond 1e38, a number
// of the MTL beyond float, or syntax at whose meaning one would only guess.
Mesh mesh_read_obj(const std::filesystem::path& file);

// The same of a PLY or glTF file, by brume-mesh. A mesh of glTF is where its node puts it; one that several nodes have
// is a part. InputError also where a PLY ends before its header says so, and where the file makes the reader crash.
Mesh mesh_read_foreign(const std::filesystem::path& file);

// By the ending, one of mesh_endings().
Mesh mesh_read(const std::filesystem::path& file);
const std::vector<std::string>& mesh_endings();  // in lower case, with the dot

// Gives every corner without a normal one: the angle-weighted mean over the triangles of its smoothing group that share
// its position [Thuermer98]; with `crease` (degrees) only over those that edges of at most this angle join to it.
void mesh_complete_normals(Mesh& mesh, std::optional<double> crease = {});

}  // namespace brume
