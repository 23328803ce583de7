// See gathered_mesh.hpp. Materials: gathered_materials.cpp.
#include "assimp/gathered_mesh.hpp"

#include <algorithm>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>

#include "assimp/gathered_materials.hpp"
#include "base/error.hpp"
#include "mesh/mesh.hpp"

namespace brume {

namespace {

constexpr unsigned SHARED_FACES_MIN = 33;  // a copy of fewer takes no more room than where it stands

constexpr std::size_t VERTICES_MAX = std::numeric_limits<std::int32_t>::max();

glm::dmat4 matrix_of(const aiMatrix4x4& m) {  // which is written by rows
  return glm::transpose(
      glm::dmat4(m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4));
}

std::array<double, 3> triple(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
glm::dvec3 vector_of(const aiVector3D& v) { return {v.x, v.y, v.z}; }

class Gatherer {
 public:
  Gatherer(const aiScene& scene, bool has_materials, GatheredMesh& out)
      : scene_(scene), has_materials_(has_materials), out_(out), places_(scene.mNumMeshes) {}

  void run() {
    if (scene_.mRootNode) node(*scene_.mRootNode, glm::dmat4(1.0));
    for (const auto& [mesh, place] : uses_)
      if (!is_shared(mesh)) add(*scene_.mMeshes[mesh], glm::dmat4(places_[mesh][place]));
    for (unsigned i = 0; i < scene_.mNumMeshes; ++i) {
      if (!is_shared(i)) continue;
      out_.parts.push_back({out_.faces.size(), places_[i].size()});
      out_.placements.insert(out_.placements.end(), places_[i].begin(), places_[i].end());
      add(*scene_.mMeshes[i], glm::dmat4(1.0));
    }
  }

  void tell() {
    if (points_and_lines_ > 0)
      out_.notes.push_back(std::to_string(points_and_lines_) + " points and lines are left out");
    if (colored_) out_.notes.emplace_back("colours of vertices are not shown");
  }

 private:
  void node(const aiNode& node, const glm::dmat4& parent) {
    const glm::dmat4 world = parent * matrix_of(node.mTransformation);
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      if (node.mMeshes[i] >= scene_.mNumMeshes) throw InputError("a node names a mesh that is not there");
      std::vector<MeshPlacement>& places = places_[node.mMeshes[i]];
      uses_.emplace_back(node.mMeshes[i], places.size());
      places.emplace_back(world);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) this->node(*node.mChildren[i], world);
  }

  // A node may flatten a mesh, which no instance can.
  bool is_shared(unsigned mesh) const {
    const std::vector<MeshPlacement>& places = places_[mesh];
    return places.size() > 1 && scene_.mMeshes[mesh]->mNumFaces >= SHARED_FACES_MIN &&
           std::all_of(places.begin(), places.end(), placement_keeps_volume);
  }

  // A mirror turns faces around: their corners then go the other way round, as the standard says.
  void add(const aiMesh& mesh, const glm::dmat4& world) {
    if (out_.positions.size() + mesh.mNumVertices > VERTICES_MAX) throw InputError("has more than 2^31 vertices");
    const auto first = static_cast<std::int32_t>(out_.positions.size());
    const auto first_normal = static_cast<std::int32_t>(out_.normals.size());
    const auto first_uv = static_cast<std::int32_t>(out_.uvs.size());
    const glm::dmat3 normal_matrix = glm::transpose(glm::inverse(glm::dmat3(world)));
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      out_.positions.push_back(triple(glm::dvec3(world * glm::dvec4(vector_of(mesh.mVertices[i]), 1.0))));
      if (mesh.HasNormals()) out_.normals.push_back(triple(normal_matrix * vector_of(mesh.mNormals[i])));
      if (mesh.HasTextureCoords(0)) out_.uvs.push_back({mesh.mTextureCoords[0][i].x, mesh.mTextureCoords[0][i].y});
    }
    colored_ |= mesh.HasVertexColors(0);
    const bool mirrored = glm::determinant(glm::dmat3(world)) < 0;
    const std::int32_t material = has_materials_ ? static_cast<std::int32_t>(mesh.mMaterialIndex) : -1;
    // Where glTF says no normals, faces are flat; where PLY says none, they are smooth.
    const int group = has_materials_ && !mesh.HasNormals() ? GROUP_FLAT : GROUP_ALL;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices < 3) {
        ++points_and_lines_;
        continue;
      }
      out_.faces.push_back({face.mNumIndices, material, group});
      for (unsigned k = 0; k < face.mNumIndices; ++k) {
        const unsigned corner = face.mIndices[mirrored ? face.mNumIndices - 1 - k : k];
        if (corner >= mesh.mNumVertices)
          throw InputError("face " + std::to_string(f) + " names vertex " + std::to_string(corner) + " of " +
                           std::to_string(mesh.mNumVertices));
        const auto index = static_cast<std::int32_t>(corner);
        out_.corners.push_back({first + index, mesh.HasNormals() ? first_normal + index : -1,
                                mesh.HasTextureCoords(0) ? first_uv + index : -1});
      }
    }
  }

  const aiScene& scene_;
  bool has_materials_;
  GatheredMesh& out_;
  std::vector<std::vector<MeshPlacement>> places_;      // of each mesh
  std::vector<std::pair<unsigned, std::size_t>> uses_;  // in the order of the nodes: which mesh, at which of its places
  std::size_t points_and_lines_ = 0;
  bool colored_ = false;
};

}  // namespace

GatheredMesh mesh_gather(const aiScene& scene, bool has_materials) {
  GatheredMesh out;
  Gatherer gatherer(scene, has_materials, out);
  gatherer.run();
  gatherer.tell();
  if (has_materials) materials_gather(scene, out);
  return out;
}

}  // namespace brume
