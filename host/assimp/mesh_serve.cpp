// See mesh_serve.hpp.
#include "assimp/mesh_serve.hpp"

#include <assimp/config.h>

#include <assimp/Importer.hpp>

#include "assimp/gathered_mesh.hpp"
#include "base/error.hpp"
#include "base/file_read.hpp"
#include "base/helper_program.hpp"
#include "base/helper_serve.hpp"

namespace brume {

namespace {

const char* const MEMORY = "cannot be read: takes more memory than 512 MiB and 40 times its size";

// Of the many ways in which the library says so, the short one.
std::string failure_text(const std::string& said) {
  if (said.find("bad_alloc") != std::string::npos) return MEMORY;
  if (said.rfind("No suitable reader", 0) == 0)
    return "is damaged where it begins, or of another version of its format";
  return "cannot be read: Assimp says " + said;
}

template <class T>
bool send(int socket, const std::vector<T>& values) {
  return helper_send(socket, values.data(), values.size() * sizeof(T));
}

bool send_failure(int socket, const std::string& why) {
  MeshAnswer answer{};
  answer.protocol = MESH_PROTOCOL;
  answer.failed = 1;
  answer.text_bytes = why.size() + 1;
  return helper_send(socket, &answer, sizeof answer) && helper_send(socket, why.c_str(), why.size() + 1);
}

bool send_mesh(int socket, const GatheredMesh& mesh) {
  std::vector<std::uint64_t> sizes;
  std::string bytes, texts;
  for (const std::string& name : mesh.surface_names) texts += name + '\0';
  for (const GatheredImage& image : mesh.images) {
    sizes.push_back(image.bytes.size());
    bytes += image.bytes;
    texts += image.name + '\0';
  }
  for (const std::string& note : mesh.notes) texts += note + '\0';
  if (texts.size() > MESH_TEXT_MAX) throw InputError("its names are longer than 1 MiB together");
  const MeshAnswer answer{MESH_PROTOCOL,         0,
                          mesh.positions.size(), mesh.normals.size(),
                          mesh.uvs.size(),       mesh.corners.size(),
                          mesh.faces.size(),     mesh.surfaces.size(),
                          mesh.parts.size(),     mesh.placements.size(),
                          sizes.size(),          bytes.size(),
                          texts.size()};
  return helper_send(socket, &answer, sizeof answer) && send(socket, mesh.positions) && send(socket, mesh.normals) &&
         send(socket, mesh.uvs) && send(socket, mesh.corners) && send(socket, mesh.faces) &&
         send(socket, mesh.surfaces) && send(socket, mesh.parts) && send(socket, mesh.placements) &&
         send(socket, sizes) && helper_send(socket, bytes.data(), bytes.size()) &&
         helper_send(socket, texts.data(), texts.size());
}

bool read_and_send(int socket, const std::string& path) {
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  const aiScene* scene = importer.ReadFile(path, 0);
  if (!scene) throw InputError(failure_text(importer.GetErrorString()));
  return send_mesh(socket, mesh_gather(*scene, file_ending(path) != ".ply"));
}

}  // namespace

bool mesh_serve(int socket) {
  MeshRequest request{};
  if (!helper_receive(socket, &request, sizeof request) || request.protocol != MESH_PROTOCOL) return false;
  std::string path(request.path_bytes, '\0');
  if (!helper_receive(socket, path.data(), path.size())) return false;
  helper_limits(path, mesh_memory_max);
  try {
    return read_and_send(socket, path);
  } catch (const std::bad_alloc&) {
    return send_failure(socket, MEMORY);
  } catch (const InputError& error) {
    return send_failure(socket, error.what());
  } catch (const std::exception& error) {
    return send_failure(socket, failure_text(error.what()));
  }
}

}  // namespace brume
