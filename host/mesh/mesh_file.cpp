// The table of mesh formats by ending.
#include <algorithm>

#include "base/error.hpp"
#include "base/file_read.hpp"
#include "mesh/mesh.hpp"

namespace brume {

namespace {

struct FormatRow {
  std::string ending;
  Mesh (*read)(const std::filesystem::path&);
};

const std::vector<FormatRow>& formats() {
  static const std::vector<FormatRow> rows{
      {".obj", mesh_read_obj}, {".ply", mesh_read_foreign}, {".glb", mesh_read_foreign}, {".gltf", mesh_read_foreign}};
  return rows;
}

}  // namespace

const std::vector<std::string>& mesh_endings() {
  static const std::vector<std::string> endings = [] {
    std::vector<std::string> all;
    for (const FormatRow& row : formats()) all.push_back(row.ending);
    return all;
  }();
  return endings;
}

// Files of unknown endings have always been OBJ.
Mesh mesh_read(const std::filesystem::path& file) {
  const std::string ending = file_ending(file);
  const auto& rows = formats();
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const FormatRow& r) { return r.ending == ending; });
  return row == rows.end() ? mesh_read_obj(file) : row->read(file);
}

}  // namespace brume
