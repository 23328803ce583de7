// See mesh_program.hpp. A damaged process may send anything.
#include "mesh/mesh_program.hpp"

#include <algorithm>
#include <csignal>
#include <utility>

#include "base/error.hpp"
#include "base/helper_program.hpp"
#include "base/text_printable.hpp"

namespace brume {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t TEXT_SHOWN = 300;

class MeshProgram {
 public:
  explicit MeshProgram(const fs::path& file)
      : file_(file.string()), program_(helper_program_file("brume-mesh", "meshes of PLY and glTF")) {}

  SentMesh ask() {
    const std::string path = fs::absolute(fs::path(file_)).string();
    const MeshRequest request{MESH_PROTOCOL, static_cast<std::uint32_t>(path.size())};
    SentMesh sent;
    MeshAnswer a{};
    if (!program_.send(&request, sizeof request) || !program_.send(path.data(), path.size())) fail_dead();
    receive(&a, sizeof a);
    check(a);
    receive_all(sent.positions, a.positions);
    receive_all(sent.normals, a.normals);
    receive_all(sent.uvs, a.uvs);
    receive_all(sent.corners, a.corners);
    receive_all(sent.faces, a.faces);
    receive_all(sent.surfaces, a.surfaces);
    receive_all(sent.parts, a.parts);
    receive_all(sent.placements, a.placements);
    receive_all(sent.image_sizes, a.images);
    receive_all(sent.image_bytes, a.image_bytes);
    std::string text;
    receive_all(text, a.text_bytes);
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = std::min(text.find('\0', at), text.size());
      sent.texts.push_back(text_printable(text.substr(at, std::min(end - at, TEXT_SHOWN))));
      at = end + 1;
    }
    if (a.failed) throw InputError(file_ + ": " + (sent.texts.empty() ? "cannot be read" : sent.texts.front()));
    return sent;
  }

 private:
  void check(const MeshAnswer& a) const {
    double bytes = 0;
    const std::pair<std::uint64_t, std::size_t> parts[] = {
        {a.positions, sizeof(glm::dvec3)}, {a.normals, sizeof(glm::dvec3)},
        {a.uvs, sizeof(glm::dvec2)},       {a.corners, sizeof(MeshCorner)},
        {a.faces, sizeof(MeshFace)},       {a.surfaces, sizeof(MeshSurface)},
        {a.parts, sizeof(MeshSentPart)},   {a.placements, sizeof(MeshPlacement)},
        {a.images, sizeof(std::uint64_t)}, {a.image_bytes, 1}};
    for (const auto& [count, size] : parts) bytes += double(count) * double(size);
    std::error_code ignored;
    if (a.protocol != MESH_PROTOCOL || a.text_bytes > MESH_TEXT_MAX ||
        bytes > double(mesh_memory_max(fs::file_size(file_, ignored))))
      throw RuntimeError(file_ + ": brume-mesh is of another version than brume, or the file has damaged it");
  }
  void receive(void* data, std::size_t bytes) {
    if (!program_.receive(data, bytes)) fail_dead();
  }
  template <class Values>
  void receive_all(Values& values, std::uint64_t count) {
    values.resize(count);
    receive(values.data(), count * sizeof(typename Values::value_type));
  }
  [[noreturn]] void fail_dead() {
    const std::string how = program_.end();
    for (const int outside : {SIGKILL, SIGTERM})
      if (how == "signal " + std::to_string(outside))
        throw RuntimeError(file_ + ": cannot be read: the reader was killed by " + how);
    throw InputError(file_ + ": is damaged: the reader ended by " + (how.empty() ? "itself" : how));
  }

  std::string file_;
  HelperProgram program_;
};

}  // namespace

SentMesh mesh_ask(const fs::path& file) { return MeshProgram(file).ask(); }

}  // namespace brume
