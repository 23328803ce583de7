// "--set /json/pointer=VALUE": changes one place of the parsed scene.
#include "base/error.hpp"
#include "scene/read_parts.hpp"

namespace brume {

void apply_override(nlohmann::json& scene, const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || text.empty() || text[0] != '/')
    throw InputError("--set " + text + ": expected /json/pointer=VALUE, e.g. /film/spp=16");
  const std::string value = text.substr(equals + 1);
  nlohmann::json parsed = nlohmann::json::parse(value, nullptr, false);
  if (parsed.is_discarded()) parsed = value;  // anything that is not JSON is a string: /render/method=dda_nearest
  try {
    scene[nlohmann::json::json_pointer(text.substr(0, equals))] = parsed;
  } catch (const nlohmann::json::exception&) {
    throw InputError("--set " + text + ": '" + text.substr(0, equals) + "' is not a place in this scene");
  }
}

}  // namespace brume
