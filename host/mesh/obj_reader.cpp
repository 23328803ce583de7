// An OBJ file → Mesh: polygons become triangles, names of materials indices.
#include "base/error.hpp"
#include "mesh/mesh.hpp"
#include "mesh/mesh_build.hpp"
#include "mesh/obj_materials.hpp"
#include "mesh/obj_parse.hpp"

namespace brume {

Mesh mesh_read_obj(const std::filesystem::path& file) {
  ObjFile obj = obj_parse(file);
  Mesh mesh;
  const std::vector<int> materials = obj_materials(file, obj, mesh);
  obj.notes.write(mesh.notes);
  mesh.positions = std::move(obj.positions);
  mesh.uvs = std::move(obj.uvs);
  mesh.normals = std::move(obj.normals);
  normals_unit(mesh);
  std::size_t dropped = 0, line = 0;
  for (const ObjFace& face : obj.faces) {
    dropped += face_add(mesh, &obj.corners[face.first], face.corners, face.material < 0 ? -1 : materials[face.material],
                        face.group);
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
