// "--set /json/pointer=VALUE": changes one place of the parsed scene, or makes it. Not the check of what VALUE means
// there.
#include <algorithm>

#include "base/error.hpp"
#include "scene/read_parts.hpp"

namespace brume {

namespace {

bool is_index(const std::string& token) {
  return token == "-" || token == "0" ||
         (!token.empty() && token.size() < 10 && token[0] != '0' &&
          token.find_first_not_of("0123456789") == std::string::npos);
}

// The tokens of a pointer, unescaped. Throws json::parse_error for a pointer that is none.
std::vector<std::string> pointer_tokens(const std::string& text) {
  std::vector<std::string> tokens;
  for (nlohmann::json::json_pointer p(text); !p.empty(); p.pop_back()) tokens.push_back(p.back());
  std::reverse(tokens.begin(), tokens.end());
  return tokens;
}

// A value in a message, on one line and short.
std::string value_text(const nlohmann::json& value) {
  const std::string text = value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return text.size() <= 40 ? text : std::string("a ") + value.type_name();
}

// One step down from what stands at `place`. Unlike json::operator[] it never fills a list up to a far index.
nlohmann::json& json_descend(nlohmann::json& at, const std::string& place, const std::string& token) {
  if (at.is_null()) at = is_index(token) ? nlohmann::json::array() : nlohmann::json::object();
  if (at.is_object()) return at[token];
  if (!at.is_array())
    throw InputError((place.empty() ? "the scene" : place) + " is " + value_text(at) +
                     ", expected an object or a list that has " + text_quote(token));
  const std::string allowed = "; allowed: 0 to " + std::to_string(at.size()) + ", or - to append";
  if (!is_index(token)) throw InputError(text_quote(token) + " is not an index of a list" + allowed);
  const std::size_t index = token == "-" ? at.size() : std::stoul(token);
  if (index > at.size()) throw InputError(text_quote(token) + " is beyond the end of the list" + allowed);
  if (index == at.size()) at.push_back(nullptr);
  return at[index];
}

// What is no JSON is a string: /render/method=dda_nearest.
nlohmann::json override_value(const std::string& text) {
  try {
    return json_parse(text, "--set");
  } catch (const InputError&) {
    return text;
  }
}

}  // namespace

void apply_override(nlohmann::json& scene, const std::string& text) {
  const auto equals = text.find('=');
  const std::string pointer = text.substr(0, equals), place = "--set " + pointer + ": ";
  if (equals == std::string::npos || pointer.empty() || pointer[0] != '/')
    throw InputError(place + "expected /json/pointer=VALUE, e.g. /film/spp=16");
  try {
    nlohmann::json* at = &scene;
    std::string reached;
    for (const std::string& token : pointer_tokens(pointer)) {
      at = &json_descend(*at, reached, token);
      reached += "/" + token;
    }
    *at = override_value(text.substr(equals + 1));
  } catch (const InputError& error) {
    throw InputError(place + error.what());
  } catch (const nlohmann::json::exception&) {
    throw InputError(place + "not a JSON pointer; '~' in a key is written ~0, '/' is written ~1");
  }
}

}  // namespace brume
