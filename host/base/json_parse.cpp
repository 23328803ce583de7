// Text → JSON with the refusals that nlohmann's parser leaves to its callers: duplicate keys, depth, numbers beyond double.
#include <set>

#include "base/error.hpp"
#include "base/json_value.hpp"

namespace brume {

namespace {

constexpr std::size_t DEPTH_MAX = 64;

// The parser's "... parse error at line 3, column 7: ..." without its own prefix.
std::string parse_message(const std::string& what) {
  const auto begin = what.find("at line");
  return begin == std::string::npos ? what : what.substr(begin);
}

// Watches the parse: one set of keys per open object.
class Watch {
 public:
  explicit Watch(const std::string& file) : file_(file) {}

  bool operator()(int depth, nlohmann::json::parse_event_t event, const nlohmann::json& parsed) {
    using Event = nlohmann::json::parse_event_t;
    if (static_cast<std::size_t>(depth) > DEPTH_MAX)
      throw InputError(file_ + ": nested deeper than " + std::to_string(DEPTH_MAX) + " levels");
    if (event == Event::object_start) keys_.emplace_back();
    if (event == Event::object_end) keys_.pop_back();
    if (event == Event::key && !keys_.back().insert(parsed.get<std::string>()).second)
      throw InputError(file_ + ": the key '" + parsed.get<std::string>() + "' stands twice in one object");
    return true;
  }

 private:
  std::string file_;
  std::vector<std::set<std::string>> keys_;
};

}  // namespace

nlohmann::json json_parse(std::string_view text, const std::string& file) {
  Watch watch(file);
  try {
    return nlohmann::json::parse(text.begin(), text.end(), std::ref(watch), true, true);
  } catch (const nlohmann::json::exception& error) {  // out_of_range for 1e400 too
    throw InputError(file + ": " + parse_message(error.what()));
  }
}

}  // namespace brume
