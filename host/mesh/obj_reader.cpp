// OBJ and MTL through tinyobjloader, whose release 2.0rc10 lets broken indices pass, drops continued lines and reads "nan" as 0: all
// three are seen to here.
#include <tiny_obj_loader.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <sstream>

#include "base/error.hpp"
#include "mesh/mesh.hpp"

namespace brume {

namespace {

using Path = std::filesystem::path;

[[noreturn]] void fail(const Path& file, const std::string& cause) { throw InputError(file.string() + ": " + cause); }

std::string obj_text(const Path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) fail(file, "is a folder, expected an OBJ file");
  std::ifstream in(file, std::ios::binary);
  if (!in) fail(file, "cannot be opened");
  std::ostringstream out;
  out << in.rdbuf();
  std::string text = out.str();
  if (text.find('\0') != std::string::npos)
    fail(file, "is not a plain text file (UTF-16 or binary); OBJ files are ASCII or UTF-8");
  return text;
}

// "\" at the end of a line continues it; the parser does not know that.
std::string lines_join(std::string text) {
  for (std::size_t at = text.find('\\'); at != std::string::npos; at = text.find('\\', at)) {
    std::size_t end = at + 1;
    if (end < text.size() && text[end] == '\r') ++end;
    if (end >= text.size() || text[end] != '\n') {
      ++at;
      continue;
    }
    text.replace(at, end + 1 - at, " ");
  }
  return text;
}

// Vertices, normals and texture coordinates must be numbers: the parser takes 0 for what is none.
void numbers_check(const Path& file, const std::string& text) {
  std::istringstream lines(text);
  std::string line, word;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    std::istringstream words(line);
    if (!(words >> word) || (word != "v" && word != "vn" && word != "vt")) continue;
    while (words >> word && word[0] != '#')
      if (word.find_first_not_of("+-.0123456789eE") != std::string::npos)
        fail(file, "line " + std::to_string(number) + ": '" + word.substr(0, 40) + "' is not a number");
  }
}

// Reads MTL files beside the OBJ; a missing one is told, and the mesh goes on in grey.
class MaterialFiles : public tinyobj::MaterialReader {
 public:
  MaterialFiles(Path folder, std::vector<std::string>& notes) : folder_(std::move(folder)), notes_(notes) {}
  bool operator()(const std::string& name, std::vector<tinyobj::material_t>* materials,
                  std::map<std::string, int>* index, std::string* warning, std::string* error) override {
    std::ifstream in(folder_ / name);
    if (!in) {
      notes_.push_back((folder_ / name).string() + ": the material library cannot be opened; the mesh is grey");
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

// An index of a corner: in range, or -1 (allowed for normals and texture coordinates, never for positions).
int index_check(const Path& file, int index, std::size_t count, bool optional, std::size_t face, const char* what) {
  if (index == -1 && optional) return -1;
  if (index < 0 || index >= static_cast<int>(count))
    fail(file, "face " + std::to_string(face + 1) + " names a " + what + " that does not exist; the file has " +
                   std::to_string(count));
  return index;
}

bool has_area(const Mesh& mesh, const MeshTriangle& t) {
  const glm::dvec3 &a = mesh.positions[t.position[0]], &b = mesh.positions[t.position[1]],
                   &c = mesh.positions[t.position[2]];
  return glm::length(glm::cross(b - a, c - a)) > 0;
}

void triangles_convert(const Path& file, const tinyobj::attrib_t& attrib, const std::vector<tinyobj::shape_t>& shapes,
                       Mesh& mesh) {
  std::size_t face = 0, dropped = 0;
  for (const tinyobj::shape_t& shape : shapes) {
    for (std::size_t f = 0; 3 * f + 2 < shape.mesh.indices.size(); ++f, ++face) {
      MeshTriangle t;
      for (int k = 0; k < 3; ++k) {
        const tinyobj::index_t& i = shape.mesh.indices[3 * f + k];
        t.position[k] = index_check(file, i.vertex_index, mesh.positions.size(), false, face, "vertex");
        t.normal[k] = index_check(file, i.normal_index, mesh.normals.size(), true, face, "normal");
        t.uv[k] = index_check(file, i.texcoord_index, attrib.texcoords.size() / 2, true, face, "texture coordinate");
        if (t.normal[k] >= 0 && mesh.normals[t.normal[k]] == glm::dvec3(0)) t.normal[k] = -1;
      }
      const int material = f < shape.mesh.material_ids.size() ? shape.mesh.material_ids[f] : -1;
      t.material = material < static_cast<int>(mesh.materials.size()) ? material : -1;
      if (has_area(mesh, t)) {
        mesh.triangles.push_back(t);
      } else {
        ++dropped;
      }
    }
  }
  if (dropped > 0)
    mesh.notes.push_back(file.string() + ": " + std::to_string(dropped) + " triangles without area are left out");
}

}  // namespace

Mesh mesh_read_obj(const Path& file) {
  const std::string joined = lines_join(obj_text(file));
  numbers_check(file, joined);
  std::istringstream text(joined);
  Mesh mesh;
  tinyobj::attrib_t attrib;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string warning, error;
  MaterialFiles reader(file.parent_path(), mesh.notes);
  if (!tinyobj::LoadObj(&attrib, &shapes, &materials, &warning, &error, &text, &reader, true))
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
  triangles_convert(file, attrib, shapes, mesh);
  if (mesh.triangles.empty()) fail(file, "holds no triangle");
  return mesh;
}

}  // namespace brume
