// The table of volume formats by ending. A new format is one file in formats/ and one row here.
#include "volume/volume_file.hpp"

#include "base/error.hpp"
#include "base/file_read.hpp"
#include "volume/formats/openvdb.hpp"
#include "volume/volume_program.hpp"

namespace brume {
namespace fs = std::filesystem;

namespace {

struct FormatRow {
  std::string_view ending;
  std::vector<VolumeGridInfo> (*list)(const fs::path&, bool voxels);
  Grid (*read)(const fs::path&, const std::string& grid_name, const VolumeValues&);
  VolumeFirst (*read_first)(const fs::path&);
};
constexpr FormatRow FORMATS[] = {{".vdb", vdb_list, vdb_read, vdb_read_first}};

// The format of a file that exists and is not empty.
const FormatRow& format_of(const fs::path& file) {
  std::error_code failed;
  const fs::file_status status = fs::status(file, failed);
  if (!fs::exists(status)) throw InputError(file.string() + ": no such file");
  if (!fs::is_regular_file(status)) throw InputError(file.string() + ": not a regular file");
  std::string known;
  for (const FormatRow& row : FORMATS) {
    if (file_ending(file) == row.ending) {
      if (fs::file_size(file, failed) == 0) throw InputError(file.string() + ": the file is empty");
      return row;
    }
    known += (known.empty() ? "" : ", ") + std::string(row.ending);
  }
  throw InputError(file.string() + ": unknown volume format '" + file.extension().string() + "'; known: " + known);
}

}  // namespace

std::vector<std::string> volume_endings() {
  std::vector<std::string> endings;
  for (const FormatRow& row : FORMATS) endings.emplace_back(row.ending);
  return endings;
}

std::vector<VolumeGridInfo> volume_list(const fs::path& file, bool voxels) {
  return format_of(file).list(file, voxels);
}

Grid volume_read(const fs::path& file, const std::string& grid_name, const VolumeValues& values) {
  return format_of(file).read(file, grid_name, values);
}

VolumeFirst volume_read_first(const fs::path& file) { return format_of(file).read_first(file); }

}  // namespace brume
