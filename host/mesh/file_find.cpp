// See file_find.hpp.
#include "mesh/file_find.hpp"

#include <algorithm>
#include <string>

#include "mesh/text_lines.hpp"

namespace brume {
namespace fs = std::filesystem;

namespace {

bool is_there(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(file, ignored);
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
    } else if (is_there(at / part)) {
      at /= part;
    } else {
      at = entry_of_any_case(at, part.string());
      if (at.empty()) return {};
    }
  }
  return at;
}

}  // namespace

FoundFile file_find(const fs::path& folder, std::string_view name) {
  std::string text(name);
  if (!text.empty() && is_there(folder / text)) return {(folder / text).lexically_normal(), true, true};
  if (text.size() > 1 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  std::replace(text.begin(), text.end(), '\\', '/');
  const fs::path asked = (folder / text).lexically_normal();
  if (text.empty() || is_there(asked)) return {asked, !text.empty(), true};
  const std::string base = text.substr(text.find_last_of("/:") + 1);  // of "C:wood.png", too
  for (const std::string& other : {text, base}) {
    if (other.empty()) continue;
    const fs::path path = path_of_any_case(folder, other);
    if (!path.empty() && is_there(path)) return {path.lexically_normal(), true, false};
  }
  return {asked, false, true};
}

}  // namespace brume
