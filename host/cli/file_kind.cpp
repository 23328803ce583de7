// See file_kind.hpp.
#include "cli/file_kind.hpp"

#include <string>

#include "base/error.hpp"
#include "base/file_read.hpp"

namespace brume {

namespace {

struct KindRow {
  const char* ending;
  FileKind kind;
};
constexpr KindRow KINDS[] = {{".json", FileKind::SCENE}, {".vdb", FileKind::VOLUME}, {".obj", FileKind::MESH}};

}  // namespace

FileKind file_kind(const std::filesystem::path& file) {
  std::string known;
  for (const KindRow& row : KINDS) {
    if (file_ending(file) == row.ending) return row.kind;
    known += (known.empty() ? "" : ", ") + std::string(row.ending);
  }
  std::error_code failed;
  const std::filesystem::file_status status = std::filesystem::status(file, failed);
  if (std::filesystem::is_directory(status))
    throw InputError(file.string() + ": is a folder, expected a file of a known kind: " + known);
  if (!std::filesystem::exists(status))
    throw InputError(file.string() + ": cannot be opened: No such file or directory");
  throw InputError(file.string() + ": unknown kind of file '" + file.extension().string() + "'; known: " + known);
}

}  // namespace brume
