// An OBJ file → Mesh: polygons become triangles, names of materials indices.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/error.hpp"
#include "base/file_read.hpp"
#include "mesh/mesh.hpp"
#include "mesh/obj_materials.hpp"
#include "mesh/obj_parse.hpp"
#include "mesh/polygon.hpp"

namespace brume {

namespace {

bool has_area(const Mesh& mesh, const MeshTriangle& t) {
  const glm::dvec3 &a = mesh.positions[t.position[0]], &b = mesh.positions[t.position[1]],
                   &c = mesh.positions[t.position[2]];
  return glm::length(glm::cross(b - a, c - a)) > 0;
}

// Unit, of whatever length in double; 0 stays 0.
glm::dvec3 unit(const glm::dvec3& n) {
  const double largest = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
  return largest > 0 ? glm::normalize(n / largest) : n;
}

// Positions that no triangle has go: a stray one far away must not count to the size of the mesh.
void positions_compact(Mesh& mesh) {
  std::vector<int> index(mesh.positions.size(), -1);
  std::vector<glm::dvec3> used;
  for (MeshTriangle& t : mesh.triangles)
    for (int& position : t.position) {
      if (index[position] < 0) {
        index[position] = static_cast<int>(used.size());
        used.push_back(mesh.positions[position]);
      }
      position = index[position];
    }
  mesh.positions = std::move(used);
}

// The triangles of one face; returns how many have no area and are left out.
std::size_t face_convert(const std::array<int, 3>* corners, const ObjFace& face, int material, Mesh& mesh) {
  std::vector<glm::dvec3> around;
  for (std::size_t k = 0; k < face.corners; ++k) around.push_back(mesh.positions.at(corners[k][0]));
  std::size_t dropped = 0;
  for (const std::array<int, 3>& cut : polygon_triangulate(around)) {
    MeshTriangle t;
    for (int k = 0; k < 3; ++k) {
      const auto [position, uv, normal] = corners[cut[k]];
      t.position[k] = position;
      t.normal[k] = normal >= 0 && mesh.normals.at(normal) != glm::dvec3(0) ? normal : -1;
      t.uv[k] = uv;
    }
    t.material = material;
    t.group = face.group;
    if (has_area(mesh, t)) {
      mesh.triangles.push_back(t);
    } else {
      ++dropped;
    }
  }
  return dropped;
}

}  // namespace

Mesh mesh_read_obj(const std::filesystem::path& file) {
  ObjFile obj = obj_parse(file);
  Mesh mesh;
  const std::vector<int> materials = obj_materials(file, obj, mesh);
  obj.notes.write(mesh.notes);
  mesh.positions = std::move(obj.positions);
  mesh.uvs = std::move(obj.uvs);
  mesh.normals = std::move(obj.normals);
  for (glm::dvec3& n : mesh.normals) n = unit(n);
  std::size_t dropped = 0, line = 0;
  for (const ObjFace& face : obj.faces) {
    dropped += face_convert(&obj.corners[face.first], face, face.material < 0 ? -1 : materials[face.material], mesh);
    if (dropped > 0 && line == 0) line = face.line;
  }
  if (dropped > 0)
    mesh.notes.push_back(file.string() + ": line " + std::to_string(line) + ": " + std::to_string(dropped) +
                         " triangles without area, from this line on, are left out");
  if (mesh.triangles.empty())
    throw InputError(file.string() + ": holds no triangle: " + std::to_string(mesh.positions.size()) + " vertices, " +
                     std::to_string(obj.faces.size()) + " faces of three or more corners");
  positions_compact(mesh);
  return mesh;
}

}  // namespace brume
