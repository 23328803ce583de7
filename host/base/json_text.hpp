// JSON as people write it: what is short stands on one line. Not the parser: json_value.hpp.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace brume {

// The outermost object or list takes a line per member; inner ones only where they do not fit on one line. Throws
// nlohmann's type_error for a text that is not UTF-8.
std::string json_text(const nlohmann::ordered_json& json);

// As JSON's dump: -1 for one line, else the indentation. Bytes that are no UTF-8, as names of files may hold them, are
// replaced.
std::string json_line(const nlohmann::ordered_json& json, int indent = -1);

}  // namespace brume
