// OBJ and MTL through tinyobjloader, of whose release 2.0rc10 two things are not used: its trust in what it reads (obj_text) and
// its cutting of polygons, which loses parts of those that do not surround the origin (polygon).
#include <tiny_obj_loader.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <sstream>

#include "base/error.hpp"
#include "base/file_read.hpp"
#include "mesh/mesh.hpp"
#include "mesh/obj_text.hpp"
#include "mesh/polygon.hpp"

namespace brume {

namespace {

using Path = std::filesystem::path;

constexpr std::size_t MTL_BYTES_MAX = 64u << 20;

[[noreturn]] void fail(const Path& file, const std::string& cause) { throw InputError(file.string() + ": " + cause); }

// Reads MTL files beside the OBJ; a missing one is told, and the mesh goes on in grey.
class MaterialFiles : public tinyobj::MaterialReader {
 public:
  MaterialFiles(Path folder, std::vector<std::string>& notes) : folder_(std::move(folder)), notes_(notes) {}
  bool operator()(const std::string& name, std::vector<tinyobj::material_t>* materials,
                  std::map<std::string, int>* index, std::string* warning, std::string* error) override {
    std::istringstream in;
    try {
      in.str(file_read_text(folder_ / name, MTL_BYTES_MAX, "a material library"));
    } catch (const InputError& failure) {
      notes_.push_back(std::string(failure.what()) + "; the mesh is grey");
      return false;
    }
    tinyobj::LoadMtl(index, materials, &in, warning, error);
    return true;
  }

 private:
  Path folder_;
  std::vector<std::string>& notes_;
};

glm::dvec3 triple(const tinyobj::real_t* v) { return {v[0], v[1], v[2]}; }

MeshMaterial material_convert(const tinyobj::material_t& m, const Path& folder) {
  MeshMaterial out;
  out.name = m.name;
  out.diffuse = glm::max(triple(m.diffuse), glm::dvec3(0));
  out.specular = glm::max(triple(m.specular), glm::dvec3(0));
  out.ambient = glm::max(triple(m.ambient), glm::dvec3(0));
  out.emission = glm::max(triple(m.emission), glm::dvec3(0));
  out.shininess = std::max(0.0, static_cast<double>(m.shininess));
  std::string texture = m.diffuse_texname;
  std::replace(texture.begin(), texture.end(), '\\', '/');
  if (!texture.empty()) out.texture = (folder / texture).lexically_normal();
  return out;
}

std::vector<glm::dvec3> positions_convert(const Path& file, const std::vector<tinyobj::real_t>& flat,
                                          const char* what) {
  std::vector<glm::dvec3> out;
  for (std::size_t i = 0; i + 2 < flat.size(); i += 3) {
    out.push_back(triple(&flat[i]));
    for (int k = 0; k < 3; ++k)
      if (!std::isfinite(out.back()[k]) || std::abs(out.back()[k]) > 1e18)
        fail(file, std::string(what) + " " + std::to_string(i / 3 + 1) + " is not finite or beyond 1e18");
  }
  return out;
}

bool has_area(const Mesh& mesh, const MeshTriangle& t) {
  const glm::dvec3 &a = mesh.positions[t.position[0]], &b = mesh.positions[t.position[1]],
                   &c = mesh.positions[t.position[2]];
  return glm::length(glm::cross(b - a, c - a)) > 0;
}

// The triangles of one face; returns how many have no area and are left out.
std::size_t face_convert(const tinyobj::index_t* corners, std::size_t count, int material, Mesh& mesh) {
  std::vector<glm::dvec3> around;
  for (std::size_t k = 0; k < count; ++k) around.push_back(mesh.positions.at(corners[k].vertex_index));
  std::size_t dropped = 0;
  for (const std::array<int, 3>& cut : polygon_triangulate(around)) {
    MeshTriangle t;
    for (int k = 0; k < 3; ++k) {
      const tinyobj::index_t& i = corners[cut[k]];
      t.position[k] = i.vertex_index;
      t.normal[k] = i.normal_index >= 0 && mesh.normals.at(i.normal_index) != glm::dvec3(0) ? i.normal_index : -1;
      t.uv[k] = i.texcoord_index;
    }
    t.material = material < static_cast<int>(mesh.materials.size()) ? material : -1;
    if (has_area(mesh, t)) {
      mesh.triangles.push_back(t);
    } else {
      ++dropped;
    }
  }
  return dropped;
}

// `corners`: of each face; the parser's own count ends at 255.
void faces_convert(const Path& file, const std::vector<std::size_t>& corners,
                   const std::vector<tinyobj::shape_t>& shapes, Mesh& mesh) {
  std::size_t face = 0, dropped = 0;
  for (const tinyobj::shape_t& shape : shapes) {
    const std::vector<tinyobj::index_t>& indices = shape.mesh.indices;
    std::size_t at = 0;
    for (const int material : shape.mesh.material_ids) {
      if (face == corners.size() || corners[face] > indices.size() - at) break;
      dropped += face_convert(&indices[at], corners[face], material, mesh);
      at += corners[face++];
    }
    if (at != indices.size()) fail(file, "its faces cannot be told apart");
  }
  if (dropped > 0)
    mesh.notes.push_back(file.string() + ": " + std::to_string(dropped) + " triangles without area are left out");
}

}  // namespace

Mesh mesh_read_obj(const Path& file) {
  const ObjText checked = obj_text_read(file);
  std::istringstream text(checked.text);
  Mesh mesh;
  tinyobj::attrib_t attrib;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string warning, error;
  MaterialFiles reader(file.parent_path(), mesh.notes);
  if (!tinyobj::LoadObj(&attrib, &shapes, &materials, &warning, &error, &text, &reader, false))
    fail(file, "not a readable OBJ file: " + error.substr(0, error.find('\n')));
  mesh.positions = positions_convert(file, attrib.vertices, "vertex");
  mesh.normals = positions_convert(file, attrib.normals, "normal");
  for (glm::dvec3& n : mesh.normals)
    if (glm::length(n) > 0) n = glm::normalize(n);
  for (std::size_t i = 0; i + 1 < attrib.texcoords.size(); i += 2) {
    mesh.uvs.emplace_back(attrib.texcoords[i], attrib.texcoords[i + 1]);
    if (!std::isfinite(mesh.uvs.back().x) || !std::isfinite(mesh.uvs.back().y))
      fail(file, "texture coordinate " + std::to_string(i / 2 + 1) + " is not finite");
  }
  for (const tinyobj::material_t& m : materials) mesh.materials.push_back(material_convert(m, file.parent_path()));
  faces_convert(file, checked.corners, shapes, mesh);
  if (mesh.triangles.empty()) fail(file, "holds no triangle");
  return mesh;
}

}  // namespace brume
