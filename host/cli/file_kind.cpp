// See file_kind.hpp.
#include "cli/file_kind.hpp"

#include <algorithm>
#include <vector>

#include "base/error.hpp"
#include "base/file_read.hpp"
#include "mesh/mesh.hpp"
#include "volume/volume_file.hpp"

namespace brume {

namespace {

struct KindRow {
  FileKind kind;
  const char* name;
  std::vector<std::string> endings;
};

std::vector<KindRow> kinds() {
  return {{FileKind::SCENE, "scene", {".json"}},
          {FileKind::VOLUME, "volume", volume_endings()},
          {FileKind::MESH, "mesh", mesh_endings()}};
}

std::string joined(const std::vector<std::string>& endings) {
  std::string text;
  for (const std::string& ending : endings) text += (text.empty() ? "" : ", ") + ending;
  return text;
}

}  // namespace

std::string file_kinds_text() {
  std::string text;
  const std::vector<KindRow> rows = kinds();
  for (std::size_t i = 0; i < rows.size(); ++i)
    text += (i == 0 ? "" : (i + 1 == rows.size() ? " or " : ", ")) + std::string(rows[i].name) + " (" +
            joined(rows[i].endings) + ")";
  return text;
}

FileKind file_kind(const std::filesystem::path& file) {
  std::vector<std::string> endings;
  for (const KindRow& row : kinds()) {
    if (std::find(row.endings.begin(), row.endings.end(), file_ending(file)) != row.endings.end()) return row.kind;
    endings.insert(endings.end(), row.endings.begin(), row.endings.end());
  }
  const std::string known = joined(endings);
  std::error_code failed;
  const std::filesystem::file_status status = std::filesystem::status(file, failed);
  if (std::filesystem::is_directory(status))
    throw InputError(file.string() + ": is a folder, expected a file of a known kind: " + known);
  if (!std::filesystem::exists(status))
    throw InputError(file.string() + ": cannot be opened: No such file or directory");
  throw InputError(file.string() + ": unknown kind of file '" + file.extension().string() + "'; known: " + known);
}

}  // namespace brume
