// See json_text.hpp.
#include "base/json_text.hpp"

namespace brume {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t LINE_MAX_LENGTH = 110;

// `json` on one line, with a space after every comma.
std::string line_text(const Json& json) {
  if (!json.is_structured()) return json.dump();
  std::string text;
  for (const auto& item : json.items())
    text +=
        (text.empty() ? "" : ", ") + (json.is_object() ? Json(item.key()).dump() + ": " : "") + line_text(item.value());
  return json.is_object() ? "{" + text + "}" : "[" + text + "]";
}

// What fits stays on one line, the rest takes a line per member.
std::string block_text(const Json& json, std::size_t indent, std::size_t column) {
  const std::string line = line_text(json);
  if (!json.is_structured() || column + line.size() <= LINE_MAX_LENGTH) return line;
  const std::string inner(indent + 2, ' ');
  std::string text;
  for (const auto& item : json.items()) {
    const std::string key = json.is_object() ? Json(item.key()).dump() + ": " : "";
    text.append(text.empty() ? "\n" : ",\n").append(inner).append(key);
    text += block_text(item.value(), indent + 2, indent + 2 + key.size());
  }
  return line.front() + text + "\n" + std::string(indent, ' ') + line.back();
}

}  // namespace

std::string json_line(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

std::string json_text(const Json& json) { return block_text(json, 0, LINE_MAX_LENGTH) + "\n"; }

}  // namespace brume
