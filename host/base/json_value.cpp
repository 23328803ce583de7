// See json_value.hpp. Parsing: json_parse.cpp.
#include "base/json_value.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"

namespace brume {

namespace {

constexpr double INF = std::numeric_limits<double>::infinity();

std::string number_text(double v) {
  std::string text = nlohmann::json(v).dump();
  if (text.size() > 2 && text.substr(text.size() - 2) == ".0") text.resize(text.size() - 2);
  return text;
}

std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] != b[j - 1])});
      diagonal = above;
    }
  }
  return row[b.size()];
}

// "~" and "/" in keys as JSON pointers write them.
std::string pointer_key(const std::string& key) {
  std::string out;
  for (const char c : key) out += c == '~' ? "~0" : (c == '/' ? "~1" : std::string(1, c));
  return out;
}

}  // namespace

std::string Range::text() const {
  if (lo == -INF && hi == INF) return "";
  if (hi == INF) return (lo_open ? " > " : " >= ") + number_text(lo);
  return std::string(" in ") + (lo_open ? "(" : "[") + number_text(lo) + ", " + number_text(hi) + (hi_open ? ")" : "]");
}
Range Range::any() { return {-INF, INF, true, true}; }
Range Range::positive() { return {0, INF, true, true}; }
Range Range::at_least_0() { return {0, INF, false, true}; }
Range Range::closed(double lo, double hi) { return {lo, hi, false, false}; }
Range Range::open(double lo, double hi) { return {lo, hi, true, true}; }

JsonValue::JsonValue(const nlohmann::json& json, std::string file, std::string place)
    : json_(&json), file_(std::move(file)), place_(std::move(place)), read_(std::make_shared<std::set<std::string>>()) {}

void JsonValue::fail(const std::string& cause) const {
  throw InputError(file_ + ": " + (place_.empty() ? "/" : place_) + ": " + cause);
}

std::string JsonValue::got() const {
  std::string text = json_->dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  if (text.size() > 60) text = text.substr(0, 57) + "...";
  return ", got " + text;
}

double JsonValue::as_number(const Range& range) const {
  if (!json_->is_number()) fail("expected a number" + range.text() + got());
  const double v = json_->get<double>();
  if (!std::isfinite(v) || !range.holds(v)) fail("expected a number" + range.text() + got());
  return v;
}

int JsonValue::as_integer(int lo, int hi) const {
  const std::string expected = "expected an integer in [" + std::to_string(lo) + ", " + std::to_string(hi) + "]";
  if (!json_->is_number()) fail(expected + got());
  const double v = json_->get<double>();
  if (!(v >= lo && v <= hi) || v != std::floor(v)) fail(expected + got());
  return static_cast<int>(v);
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
  if (!row) fail(std::string("unknown ") + what + " '" + name + "'; known: " + family_names(family));
  return row->id;
}

std::vector<JsonValue> JsonValue::as_list() const {
  if (!json_->is_array()) fail("expected a list" + got());
  std::vector<JsonValue> items;
  for (std::size_t i = 0; i < json_->size(); ++i) items.emplace_back((*json_)[i], file_, place_ + "/" + std::to_string(i));
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
  if (!has(key)) fail("the key '" + key + "' is missing");
  return JsonValue(json_->at(key), file_, place_ + "/" + pointer_key(key));
}

double JsonValue::number(const std::string& key, double fallback, const Range& range) const {
  return has(key) ? get(key).as_number(range) : fallback;
}
int JsonValue::integer(const std::string& key, int fallback, int lo, int hi) const {
  return has(key) ? get(key).as_integer(lo, hi) : fallback;
}
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

void JsonValue::refuse_unread() const {
  expect_object();
  for (const auto& item : json_->items()) {
    if (read_->count(item.key())) continue;
    std::string nearest, known;
    for (const std::string& key : *read_) {
      known += (known.empty() ? "" : ", ") + key;
      if (edit_distance(key, item.key()) <= std::max<std::size_t>(1, key.size() / 3) &&
          (nearest.empty() || edit_distance(key, item.key()) < edit_distance(nearest, item.key())))
        nearest = key;
    }
    fail("unknown key '" + item.key() + "'" + (nearest.empty() ? "" : " (did you mean '" + nearest + "'?)") + "; known: " + known);
  }
}

}  // namespace brume
