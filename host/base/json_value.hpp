// A JSON value that knows its file, its place (JSON pointer) and which of its keys were read. Every failure is an
// InputError "file: /place: cause, what is allowed".
#pragma once
#include <glm/vec3.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/family.hpp"

namespace brume {

// A range of numbers; its text is part of the message: "expected a number > 0, got -1". An open end is compared in
// float, the precision in which scenes are rendered: g = 0.9999999999 is 1 there and 1e-60 is 0.
struct Range {
  double lo, hi;
  bool lo_open, hi_open;
  bool holds(double v) const;
  std::string text() const;

  static Range any();
  static Range positive();  // > 0
  static Range at_least(double lo);
  static Range at_least_0();
  static Range closed(double lo, double hi);
  static Range open(double lo, double hi);
};

// Text of the user in a message: shortened, in single quotes.
std::string text_quote(const std::string& text);

// Text → JSON: comments allowed; duplicate keys, more than 64 levels, numbers beyond double, empty and binary texts are
// refused. Throws InputError "file: line 3, column 7: cause".
nlohmann::json json_parse(std::string_view text, const std::string& file);

class JsonValue {
 public:
  JsonValue(const nlohmann::json& json, std::string file, std::string place = "");

  const std::string& place() const { return place_; }
  [[noreturn]] void fail(const std::string& cause) const;
  std::string got() const;  // ", got " this value, shortened: the end of a message

  // The value itself. Numbers beyond the range of float are refused in any range that does not name a larger one.
  double as_number(const Range& range) const;
  int as_integer(int lo, int hi) const;
  bool as_flag() const;
  std::string as_string() const;
  glm::dvec3 as_vec3(const Range& range) const;                 // 3 numbers
  glm::dvec3 as_color(const Range& range) const;                // 3 numbers, or 1 for a grey triple
  int as_member(const Family& family, const char* what) const;  // a name of the family
  std::vector<JsonValue> as_list() const;
  bool is_string() const { return json_->is_string(); }
  bool is_null() const { return json_->is_null(); }
  const nlohmann::json& json() const { return *json_; }

  // A member of this object. has() and get() mark the key as read; get() fails when it is absent. Copies of a JsonValue
  // share what was read, but two get() of one key do not: read an object through one of them.
  bool has(const std::string& key) const;
  JsonValue get(const std::string& key) const;
  void expect_object() const;

  // Members with a default for an absent key.
  double number(const std::string& key, double fallback, const Range& range) const;
  int integer(const std::string& key, int fallback, int lo, int hi) const;
  bool flag(const std::string& key, bool fallback) const;
  glm::dvec3 vec3(const std::string& key, const glm::dvec3& fallback, const Range& range = Range::any()) const;
  glm::dvec3 color(const std::string& key, const glm::dvec3& fallback, const Range& range) const;
  int member(const std::string& key, int fallback, const Family& family, const char* what) const;
  std::vector<JsonValue> list(const std::string& key) const;  // empty when absent

  // Fails for the first key that nobody asked for, naming the nearest one that somebody did.
  void refuse_unread() const;

 private:
  std::vector<std::string> unread() const;
  const nlohmann::json* json_;
  std::string file_, place_;
  std::shared_ptr<std::set<std::string>> read_;
};

}  // namespace brume
