// JSON as people write it: what is short stands on one line. Not the parser: json_value.hpp.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace brume {

// The outermost object or list takes a line per member; inner ones only where they do not fit on one line. Throws
// nlohmann's type_error for a text that is not UTF-8.
std::string json_text(const nlohmann::ordered_json& json);

}  // namespace brume
