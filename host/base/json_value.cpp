// See json_value.hpp. Parsing: json_parse.cpp.
#include "base/json_value.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/text_printable.hpp"
#include "base/typo.hpp"

namespace brume {

namespace {

constexpr double INF = std::numeric_limits<double>::infinity();
constexpr double FLOAT_MAX = std::numeric_limits<float>::max();
constexpr std::size_t QUOTE_MAX = 60;  // bytes of the file's own text in a message

std::string number_text(double v) {
  std::string text = nlohmann::json(v).dump();
  if (text.size() > 2 && text.substr(text.size() - 2) == ".0") text.resize(text.size() - 2);
  return text;
}

// At most QUOTE_MAX bytes, not cut within a UTF-8 character.
std::string text_shorten(std::string text) {
  if (text.size() <= QUOTE_MAX) return text;
  std::size_t end = QUOTE_MAX - 3;
  while (end > 0 && (text[end] & 0xC0) == 0x80) --end;
  return text.substr(0, end) + "...";
}

// "~" and "/" in keys as JSON pointers write them.
std::string pointer_key(const std::string& key) {
  std::string out;
  for (const char c : key) out += c == '~' ? "~0" : (c == '/' ? "~1" : std::string(1, c));
  return out;
}

}  // namespace

std::string text_quote(const std::string& text) { return "'" + text_shorten(text) + "'"; }

bool Range::holds(double v) const {
  const auto f = [](double d) { return static_cast<float>(d); };
  return (lo_open ? f(v) > f(lo) : v >= lo) && (hi_open ? f(v) < f(hi) : v <= hi);
}

std::string Range::text() const {
  if (lo == -INF && hi == INF) return "";
  if (hi == INF) return (lo_open ? " > " : " >= ") + number_text(lo);
  return std::string(" in ") + (lo_open ? "(" : "[") + number_text(lo) + ", " + number_text(hi) + (hi_open ? ")" : "]");
}
Range Range::any() { return {-INF, INF, true, true}; }
Range Range::positive() { return {0, INF, true, true}; }
Range Range::at_least(double lo) { return {lo, INF, false, true}; }
Range Range::at_least_0() { return at_least(0); }
Range Range::closed(double lo, double hi) { return {lo, hi, false, false}; }
Range Range::open(double lo, double hi) { return {lo, hi, true, true}; }

JsonValue::JsonValue(const nlohmann::json& json, std::string file, std::string place)
    : json_(&json),
      file_(std::move(file)),
      place_(std::move(place)),
      read_(std::make_shared<std::set<std::string>>()) {}

// One line whatever the keys hold: control characters of the file do not reach the terminal.
void JsonValue::fail(const std::string& cause) const {
  throw InputError(text_printable(file_ + ": " + (place_.empty() ? "/" : place_) + ": " + cause));
}

std::string JsonValue::got() const {
  return ", got " + text_shorten(json_->dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

double JsonValue::as_number(const Range& range) const {
  if (!json_->is_number()) fail("expected a number" + range.text() + got());
  const double v = json_->get<double>();
  const double most = range.hi_open ? FLOAT_MAX : std::max(FLOAT_MAX, range.hi);
  if (!(std::abs(v) <= most)) fail("expected a number of at most 3.4e38" + got());
  if (range.holds(v)) return v;
  const bool rounds =
      (v > range.lo || !range.lo_open) && (v < range.hi || !range.hi_open) && v >= range.lo && v <= range.hi;
  fail("expected a number" + range.text() + got() +
       (rounds ? ", which is " + number_text(static_cast<float>(v)) + " in single precision" : ""));
}

int JsonValue::as_integer(int lo, int hi) const {
  const std::string expected = "expected an integer in [" + std::to_string(lo) + ", " + std::to_string(hi) + "]";
  if (!json_->is_number()) fail(expected + got());
  const double v = json_->get<double>();
  if (!(v >= lo && v <= hi) || v != std::floor(v)) fail(expected + got());
  return static_cast<int>(v);
}

bool JsonValue::as_flag() const {
  if (!json_->is_boolean()) fail("expected true or false" + got());
  return json_->get<bool>();
}

std::string JsonValue::as_string() const {
  if (!json_->is_string()) fail("expected a string" + got());
  return json_->get<std::string>();
}

glm::dvec3 JsonValue::as_vec3(const Range& range) const {
  if (!json_->is_array() || json_->size() != 3) fail("expected 3 numbers" + got());
  glm::dvec3 v;
  for (int i = 0; i < 3; ++i) v[i] = JsonValue((*json_)[i], file_, place_ + "/" + std::to_string(i)).as_number(range);
  return v;
}

glm::dvec3 JsonValue::as_color(const Range& range) const {
  if (json_->is_number()) return glm::dvec3(as_number(range));
  if (!json_->is_array() || json_->size() != 3) fail("expected a number or 3 numbers" + got());
  return as_vec3(range);
}

int JsonValue::as_member(const Family& family, const char* what) const {
  const std::string name = as_string();
  const FamilyRow* row = family_find(family, name);
  if (!row) fail(std::string("unknown ") + what + " " + text_quote(name) + "; known: " + family_names(family));
  return row->id;
}

std::vector<JsonValue> JsonValue::as_list() const {
  if (!json_->is_array()) fail("expected a list" + got());
  std::vector<JsonValue> items;
  for (std::size_t i = 0; i < json_->size(); ++i)
    items.emplace_back((*json_)[i], file_, place_ + "/" + std::to_string(i));
  return items;
}

void JsonValue::expect_object() const {
  if (!json_->is_object()) fail("expected an object" + got());
}

bool JsonValue::has(const std::string& key) const {
  expect_object();
  read_->insert(key);
  return json_->contains(key);
}

JsonValue JsonValue::get(const std::string& key) const {
  if (!has(key)) {
    const std::string nearest = key_nearest(key, unread());
    fail("the key '" + key + "' is missing" + (nearest.empty() ? "" : " (it has " + text_quote(nearest) + ")"));
  }
  return JsonValue(json_->at(key), file_, place_ + "/" + pointer_key(key));
}

double JsonValue::number(const std::string& key, double fallback, const Range& range) const {
  return has(key) ? get(key).as_number(range) : fallback;
}
int JsonValue::integer(const std::string& key, int fallback, int lo, int hi) const {
  return has(key) ? get(key).as_integer(lo, hi) : fallback;
}
bool JsonValue::flag(const std::string& key, bool fallback) const { return has(key) ? get(key).as_flag() : fallback; }
glm::dvec3 JsonValue::vec3(const std::string& key, const glm::dvec3& fallback, const Range& range) const {
  return has(key) ? get(key).as_vec3(range) : fallback;
}
glm::dvec3 JsonValue::color(const std::string& key, const glm::dvec3& fallback, const Range& range) const {
  return has(key) ? get(key).as_color(range) : fallback;
}
int JsonValue::member(const std::string& key, int fallback, const Family& family, const char* what) const {
  return has(key) ? get(key).as_member(family, what) : fallback;
}
std::vector<JsonValue> JsonValue::list(const std::string& key) const {
  return has(key) ? get(key).as_list() : std::vector<JsonValue>();
}

std::vector<std::string> JsonValue::unread() const {
  std::vector<std::string> keys;
  for (const auto& item : json_->items())
    if (!read_->count(item.key())) keys.push_back(item.key());
  return keys;
}

void JsonValue::refuse_unread() const {
  expect_object();
  const std::vector<std::string> keys = unread();
  if (keys.empty()) return;
  std::string known;
  for (const std::string& key : *read_) known += (known.empty() ? "" : ", ") + key;
  const std::string nearest = key_nearest(keys.front(), {read_->begin(), read_->end()});
  fail("unknown key " + text_quote(keys.front()) + (nearest.empty() ? "" : " (did you mean '" + nearest + "'?)") +
       "; known: " + known);
}

}  // namespace brume
