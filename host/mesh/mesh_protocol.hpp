// What brume and brume-mesh (host/assimp) say to each other over a socket, in the machine's own byte order; both are
// built together. brume: MeshRequest and the path. The program: MeshAnswer and what it announces, in its order; then it
// ends.
#pragma once
#include <cstdint>

namespace brume {

inline constexpr std::int32_t MESH_PROTOCOL = 2;  // a program left over from another version is told, not guessed at
inline constexpr std::uint64_t MESH_TEXT_MAX = 1 << 20;

struct MeshRequest {
  std::int32_t protocol;
  std::uint32_t path_bytes;
};

struct MeshFace {
  std::uint32_t corners;  // the next ones; at least 3
  std::int32_t material;  // -1: none
  std::int32_t group;     // as in MeshTriangle
};

struct MeshCorner {
  std::int32_t position, normal, uv;  // -1: none
};

struct MeshSurface {
  double diffuse[3], emission[3];
  std::int32_t texture, emission_texture;            // number of an image, -1: none
  std::int32_t texture_wrap, emission_texture_wrap;  // as MeshWrap
};

// Faces of a mesh that several nodes have, each there by one of the next placements.
struct MeshSentPart {
  std::uint64_t first_face, placements;  // up to the next part, or the end
};

// Number of each; then all of the first, all of the second, and so on.
struct MeshAnswer {
  std::int32_t protocol;
  std::int32_t failed;               // 1: no more than one text, why
  std::uint64_t positions, normals;  // 3 doubles
  std::uint64_t uvs;                 // 2 doubles
  std::uint64_t corners, faces, surfaces;
  std::uint64_t parts, placements;  // MeshPlacement; parts in the order of their faces
  std::uint64_t images;             // the bytes of each, 0 where it is another file, as 8-byte numbers
  std::uint64_t image_bytes;        // of all images
  std::uint64_t text_bytes;  // texts, each ended by a NUL: a name for each surface, one for each image, then notes
};

// How much memory a mesh may take beyond what the program itself takes: a vertex has no fewer than a few bytes in a
// file and some hundred in the library.
inline std::uint64_t mesh_memory_max(std::uint64_t file_bytes) { return (std::uint64_t{512} << 20) + 40 * file_bytes; }

}  // namespace brume
