// What the scene language names but this version cannot do: one table, a row goes when the feature comes.
#include <algorithm>

#include "scene/read_parts.hpp"

namespace brume {

namespace {

struct Reserved {
  const char* key;
  const char* allowed;  // JSON: the list of the values that work today
};
constexpr Reserved RESERVED[] = {
    {"shading", R"(["flat", "phong"])"},
};

}  // namespace

void refuse_reserved(const JsonValue& mesh) {
  for (const Reserved& row : RESERVED) {
    if (!mesh.has(row.key)) continue;
    const JsonValue value = mesh.get(row.key);
    const nlohmann::json allowed = nlohmann::json::parse(row.allowed);
    if (std::find(allowed.begin(), allowed.end(), value.json()) != allowed.end()) continue;
    std::string names;
    for (const nlohmann::json& one : allowed) names += (names.empty() ? "" : ", ") + one.dump();
    value.fail("not available in this version; allowed: " + names + value.got());
  }
}

}  // namespace brume
