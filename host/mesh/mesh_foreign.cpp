// PLY and glTF → Mesh: what brume-mesh has sent, checked.
#include <algorithm>
#include <cctype>
#include <cmath>

#include "base/error.hpp"
#include "base/file_read.hpp"
#include "mesh/file_find.hpp"
#include "mesh/mesh_build.hpp"
#include "mesh/mesh_program.hpp"
#include "mesh/ply_check.hpp"

namespace brume {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t FOREIGN_BYTES_MAX = std::size_t(1) << 30;
constexpr double VERTEX_MAX = 1e38;

struct ForeignKind {
  std::string_view ending, begins, name;
};
constexpr ForeignKind FOREIGN_KINDS[] = {
    {".ply", "ply", "a PLY file"}, {".glb", "glTF", "a binary glTF file"}, {".gltf", "{", "a glTF file"}};

// That the file is what its ending says; the library would try fifty other formats.
void kind_check(const fs::path& file) {
  const std::string head = file_head(file, 64, FOREIGN_BYTES_MAX, "a mesh");
  for (const ForeignKind& kind : FOREIGN_KINDS) {
    if (file_ending(file) != kind.ending) continue;
    const std::size_t begin =
        std::min(head.find_first_not_of(kind.ending == ".gltf" ? "\xef\xbb\xbf \t\r\n" : ""), head.size());
    if (head.compare(begin, kind.begins.size(), kind.begins) != 0)
      throw InputError(file.string() + ": is no " + std::string(kind.name.substr(kind.name.find(' ') + 1)) +
                       ": expected it to begin with '" + std::string(kind.begins) + "'");
  }
}

// "my%20tex.png", as glTF writes the names of files: "my tex.png".
std::string uri_decoded(const std::string& uri) {
  std::string name;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool coded = uri[i] == '%' && i + 2 < uri.size() && std::isxdigit(static_cast<unsigned char>(uri[i + 1])) &&
                       std::isxdigit(static_cast<unsigned char>(uri[i + 2]));
    name += coded ? static_cast<char>(std::stoi(uri.substr(i + 1, 2), nullptr, 16)) : uri[i];
    if (coded) i += 2;
  }
  return name;
}

// What the program has sent, as a mesh.
class MeshConvert {
 public:
  MeshConvert(const fs::path& file, SentMesh sent)
      : file_(file), sent_(std::move(sent)), finder_({file.parent_path()}) {}

  Mesh run() {
    for (std::size_t i = 0; i < sent_.positions.size(); ++i) {
      const glm::dvec3& p = sent_.positions[i];
      for (int k = 0; k < 3; ++k)
        if (!(std::abs(p[k]) <= VERTEX_MAX)) fail("vertex " + std::to_string(i) + " is no number up to 1e38");
    }
    for (glm::dvec3& n : sent_.normals)
      if (!(std::isfinite(n.x) && std::isfinite(n.y) && std::isfinite(n.z))) n = glm::dvec3(0);
    for (const glm::dvec2& uv : sent_.uvs)
      if (!(std::abs(uv.x) <= VERTEX_MAX && std::abs(uv.y) <= VERTEX_MAX))
        fail("a texture coordinate is no number up to 1e38");
    for (const MeshPlacement& placement : sent_.placements)
      for (int k = 0; k < 4; ++k)
        for (int row = 0; row < 3; ++row)
          if (!(std::abs(placement[k][row]) <= VERTEX_MAX)) fail("the transform of a node is no number up to 1e38");
    images();
    materials();
    while (text_ < sent_.texts.size()) mesh_.notes.push_back(file_.string() + ": " + text_take());
    const std::size_t vertices = sent_.positions.size();
    mesh_.positions = std::move(sent_.positions);
    mesh_.normals = std::move(sent_.normals);
    mesh_.uvs = std::move(sent_.uvs);
    normals_unit(mesh_);
    faces();
    if (mesh_.triangles.empty())
      fail("holds no triangle: " + std::to_string(vertices) + " vertices, " + std::to_string(sent_.faces.size()) +
           " faces of three or more corners");
    positions_compact(mesh_);
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& cause) const { throw InputError(file_.string() + ": " + cause); }
  [[noreturn]] void fail_sent() const { fail("is damaged: the reader has sent what is no mesh"); }

  std::string text_take() {
    if (text_ == sent_.texts.size()) fail_sent();
    return sent_.texts[text_++];
  }

  void images() {
    for (std::size_t i = 0; i < sent_.surfaces.size(); ++i) surface_names_.push_back(text_take());
    std::size_t at = 0;
    for (const std::uint64_t size : sent_.image_sizes) {
      MeshTexture texture;
      const std::string name = text_take();
      if (size > sent_.image_bytes.size() - at) fail_sent();
      if (size > 0) {
        mesh_.images.push_back(
            std::make_shared<const MemoryFile>(std::string_view(sent_.image_bytes).substr(at, size)));
        texture.file = mesh_.images.back()->path();
        texture.name = file_.string() + ": " + name;
        at += size;
      } else {
        const FoundFile& as_written = finder_.find(name);
        texture.file = as_written.found ? as_written.path : finder_.find(uri_decoded(name)).path;
      }
      textures_.push_back(texture);
    }
    sent_.image_bytes.clear();
  }

  MeshTexture texture(std::int32_t index, std::int32_t wrap) const {
    if (index >= static_cast<std::int32_t>(textures_.size()) || wrap < 0 || wrap > static_cast<int>(MeshWrap::MIRROR))
      fail_sent();
    if (index < 0) return {};
    MeshTexture texture = textures_[static_cast<std::size_t>(index)];
    texture.wrap = static_cast<MeshWrap>(wrap);
    return texture;
  }

  void materials() {
    for (std::size_t i = 0; i < sent_.surfaces.size(); ++i) {
      const MeshSurface& s = sent_.surfaces[i];
      MeshMaterial material;
      material.name = surface_names_[i];
      for (int c = 0; c < 3; ++c) {
        if (!(s.diffuse[c] >= 0 && s.diffuse[c] <= COLOR_MAX && s.emission[c] >= 0 && s.emission[c] <= COLOR_MAX))
          fail("material '" + material.name + "': a colour is no number from 0 to 1e6");
        material.diffuse[c] = material.ambient[c] = s.diffuse[c];
        material.emission[c] = s.emission[c];
      }
      material.texture = texture(s.texture, s.texture_wrap);
      material.emission_texture = texture(s.emission_texture, s.emission_texture_wrap);
      mesh_.materials.push_back(material);
    }
  }

  void faces() {
    const auto in = [](std::int32_t index, std::size_t count, std::int32_t least) {
      return index >= least && (index < 0 || static_cast<std::size_t>(index) < count);
    };
    std::size_t first = 0, dropped = 0;
    std::vector<std::array<int, 3>> corners;
    for (std::size_t f = 0; f < sent_.faces.size(); ++f) {
      const MeshFace& face = sent_.faces[f];
      part_begin(f);
      if (face.corners < 3 || face.corners > sent_.corners.size() - first || face.group < GROUP_ALL ||
          !in(face.material, mesh_.materials.size(), -1))
        fail_sent();
      corners.clear();
      for (std::size_t k = first; k < first + face.corners; ++k) {
        const MeshCorner& c = sent_.corners[k];
        if (!in(c.position, mesh_.positions.size(), 0) || !in(c.normal, mesh_.normals.size(), -1) ||
            !in(c.uv, mesh_.uvs.size(), -1))
          fail_sent();
        corners.push_back({c.position, c.uv, c.normal});
      }
      dropped += face_add(mesh_, corners.data(), corners.size(), face.material, face.group);
      first += face.corners;
    }
    if (dropped > 0)
      mesh_.notes.push_back(file_.string() + ": " + std::to_string(dropped) + " triangles without area are left out");
    if (!mesh_.parts.empty()) mesh_.parts.back().count = mesh_.triangles.size() - mesh_.parts.back().first;
  }

  // Where a part begins with face f, that before it ends.
  void part_begin(std::size_t f) {
    const std::size_t next = mesh_.parts.size();
    if (next == sent_.parts.size() || sent_.parts[next].first_face > f) return;
    const MeshSentPart& part = sent_.parts[next];
    if (part.placements > sent_.placements.size() - placement_) fail_sent();
    if (next > 0) mesh_.parts.back().count = mesh_.triangles.size() - mesh_.parts.back().first;
    const auto begin = sent_.placements.begin() + static_cast<std::ptrdiff_t>(placement_);
    placement_ += part.placements;
    mesh_.parts.push_back({mesh_.triangles.size(), 0, {begin, begin + static_cast<std::ptrdiff_t>(part.placements)}});
  }

  static constexpr double COLOR_MAX = 1e6;
  const fs::path file_;
  SentMesh sent_;
  std::size_t text_ = 0, placement_ = 0;  // of sent_.texts and sent_.placements, the next
  FileFinder finder_;
  std::vector<MeshTexture> textures_;
  std::vector<std::string> surface_names_;
  Mesh mesh_;
};

}  // namespace

Mesh mesh_read_foreign(const fs::path& file) {
  kind_check(file);
  if (file_ending(file) == ".ply") ply_check(file);
  return MeshConvert(file, mesh_ask(file)).run();
}

}  // namespace brume
