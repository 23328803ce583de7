// Text → JSON with the refusals that nlohmann's parser leaves to its callers: duplicate keys, depth, numbers beyond
// double, texts that are none. Not the reading of values: json_value.cpp.
#include <algorithm>
#include <iterator>
#include <set>

#include "base/error.hpp"
#include "base/json_value.hpp"
#include "base/text_printable.hpp"

namespace brume {

namespace {

constexpr int DEPTH_MAX = 64;
constexpr std::size_t MESSAGE_MAX = 240;

// Walks the text and tells how far the parser has come, because the parser's callback is not told.
struct Cursor {
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;
  const char* at;
  const char** reached;

  reference operator*() const { return *at; }
  Cursor& operator++() {
    *reached = ++at;
    return *this;
  }
  Cursor operator++(int) {
    const Cursor before = *this;
    ++*this;
    return before;
  }
  bool operator==(const Cursor& other) const { return at == other.at; }
  bool operator!=(const Cursor& other) const { return at != other.at; }
};

// "line 3, column 7" of the character before `reached`, as the parser counts in its own messages.
std::string place_text(const char* begin, const char* reached) {
  if (reached > begin && reached[-1] == '\n') --reached;
  const char* line = std::find(std::make_reverse_iterator(reached), std::make_reverse_iterator(begin), '\n').base();
  return "line " + std::to_string(1 + std::count(begin, reached, '\n')) + ", column " + std::to_string(reached - line);
}

// The parser stops at the first byte that it does not expect and quotes it alone: the rest of its character is added.
void complete_quote(std::string& text, const char* reached, const char* end) {
  const auto at = text.find(reached[-1], text.find("last read: "));
  if ((reached[-1] & 0xC0) != 0xC0 || at == std::string::npos) return;
  const char* last = reached;
  while (last < end && (*last & 0xC0) == 0x80) ++last;
  text.insert(at + 1, reached, static_cast<std::size_t>(last - reached));
}

// "[json.exception...] parse error at line 3, column 7: cause" → "line 3, column 7: cause", short and printable: the
// parser quotes the text, which may be anything.
std::string parse_message(std::string what, const std::string& place, const char* reached, const char* end) {
  complete_quote(what, reached, end);
  const auto at = what.find("at line ");
  const auto bracket = what.find("] ");
  std::string text = at != std::string::npos ? what.substr(at + 3) : place + ": " + what.substr(bracket + 2);
  // A number at the end of a line is only seen to end in the next one, whose column 0 is nobody's place.
  if (const auto zero = text.find(", column 0: "); zero != std::string::npos) text = place + text.substr(zero + 10);
  if (text.size() > MESSAGE_MAX)
    text = text.substr(0, MESSAGE_MAX / 2) + "..." + text.substr(text.size() - MESSAGE_MAX / 2);
  return text_printable(text);
}

// Watches the parse: one set of keys per open object.
class Watch {
 public:
  void see(int depth, nlohmann::json::parse_event_t event, const nlohmann::json& parsed) {
    using Event = nlohmann::json::parse_event_t;
    const bool opens = event == Event::object_start || event == Event::array_start;
    if (opens && depth >= DEPTH_MAX) throw InputError("nested deeper than " + std::to_string(DEPTH_MAX) + " levels");
    if (event == Event::object_start) keys_.emplace_back();
    if (event == Event::object_end) keys_.pop_back();
    if (event == Event::key && !keys_.back().insert(parsed.get<std::string>()).second)
      throw InputError("the key " + text_quote(parsed.get<std::string>()) + " stands twice in one object");
  }

 private:
  std::vector<std::set<std::string>> keys_;
};

}  // namespace

nlohmann::json json_parse(std::string_view text, const std::string& file) {
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos)
    throw InputError(file + ": is empty, expected JSON text");
  if (text.find('\0') != std::string_view::npos)
    throw InputError(file + ": is not a plain text file (binary or UTF-16), expected JSON text in UTF-8");
  const char* begin = text.data();
  const char* reached = begin;
  Watch watch;
  const auto see = [&](int depth, nlohmann::json::parse_event_t event, const nlohmann::json& parsed) {
    watch.see(depth, event, parsed);
    return true;
  };
  try {
    const Cursor first{begin, &reached}, last{begin + text.size(), &reached};
    return nlohmann::json::parse(first, last, see, true, true);
  } catch (const InputError& error) {
    throw InputError(file + ": " + place_text(begin, reached) + ": " + error.what());
  } catch (const nlohmann::json::exception& error) {  // out_of_range for 1e400 too
    throw InputError(file + ": " +
                     parse_message(error.what(), place_text(begin, reached), reached, begin + text.size()));
  }
}

}  // namespace brume
