// See file_find.hpp.
#include "mesh/file_find.hpp"

#include <algorithm>
#include <string>

#include "mesh/text_lines.hpp"

namespace brume {
namespace fs = std::filesystem;

namespace {

constexpr std::size_t NAME_MAX_BYTES = 4096;  // no system has longer ones

bool is_there(const fs::path& file) {
  std::error_code ignored;
  const fs::file_status status = fs::status(file, ignored);
  return fs::exists(status) && !fs::is_directory(status);
}

// The entry of a folder whose name differs in case alone, the first by name of several; empty for none.
fs::path entry_of_any_case(const fs::path& folder, const std::string& name) {
  fs::path best;
  std::error_code error;
  fs::directory_iterator entry(folder.empty() ? fs::path(".") : folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    const fs::path found = entry->path().filename();
    if (text_lower(found.string()) == text_lower(name) && (best.empty() || found < best)) best = found;
  }
  return best.empty() ? best : folder / best;
}

// Every part of the path in any case; empty where one is not there.
fs::path path_of_any_case(const fs::path& folder, const fs::path& name) {
  fs::path at = folder;
  for (const fs::path& part : name.lexically_normal()) {
    if (part.is_absolute()) {
      at = part;
    } else if (std::error_code ignored; fs::exists(at / part, ignored)) {
      at /= part;
    } else {
      at = entry_of_any_case(at, part.string());
      if (at.empty()) return {};
    }
  }
  return at;
}

// "C:/art/wood.png": that, art/wood.png, wood.png.
std::vector<std::string> ends_of(const std::string& name) {
  std::vector<std::string> ends{name};
  for (std::size_t at = name.find_first_of("/:"); at != std::string::npos; at = name.find_first_of("/:", at + 1))
    if (at + 1 < name.size() && name[at + 1] != '/') ends.push_back(name.substr(at + 1));
  return ends;
}

}  // namespace

const FoundFile& FileFinder::find(std::string_view name) {
  const auto known = known_.find(name);
  if (known != known_.end()) return known->second;
  return known_.emplace(std::string(name), look(name)).first->second;
}

FoundFile FileFinder::look(std::string_view name) const {
  std::string text(name);
  const auto beside = [&](const fs::path& folder) { return (folder / text).lexically_normal(); };
  for (const fs::path& folder : folders_)
    if (is_there(folder / text)) return {beside(folder), true, true};
  if (text.size() > 1 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  std::replace(text.begin(), text.end(), '\\', '/');
  for (const fs::path& folder : folders_)
    if (is_there(folder / text)) return {beside(folder), true, true};
  if (text.size() <= NAME_MAX_BYTES)
    for (const std::string& end : ends_of(text))
      for (const fs::path& folder : folders_) {
        const fs::path path = path_of_any_case(folder, end);
        if (!path.empty() && is_there(path)) return {path.lexically_normal(), true, false};
      }
  return {beside(folders_.front()), false, true};
}

}  // namespace brume
