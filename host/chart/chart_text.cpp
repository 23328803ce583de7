// See chart_text.hpp. The columns are a table: CSV, the keys of points in JSON and the page's table all have its order.
#include "chart/chart_text.hpp"

#include <cstdint>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/file_read.hpp"
#include "base/json_text.hpp"
#include "base/json_value.hpp"
#include "base/number_text.hpp"
#include "scene/families.hpp"

namespace brume {

namespace {

using Json = nlohmann::ordered_json;

struct Column {
  const char* name;
  Json (*value)(const ChartPoint&);
};

Json text_of(const Family& family, int id) { return std::string(family_name(family, id)); }
bool has_media(const ChartPoint& p) { return p.knobs.method != METHOD_NONE; }
bool takes_rule(const ChartPoint& p) { return has_media(p) && !(p.knobs.tolerance > 0); }

const Column COLUMNS[] = {
    {"method", [](const ChartPoint& p) -> Json { return knobs_method(p.knobs); }},
    {"step", [](const ChartPoint& p) { return p.knobs.step > 0 ? Json(p.knobs.step) : Json(); }},
    {"tolerance", [](const ChartPoint& p) { return p.knobs.tolerance > 0 ? Json(p.knobs.tolerance) : Json(); }},
    {"level", [](const ChartPoint& p) { return p.knobs.level > 0 ? Json(p.knobs.level) : Json(); }},
    {"light_grid", [](const ChartPoint& p) { return p.knobs.light_grid > 0 ? Json(p.knobs.light_grid) : Json(); }},
    {"storage", [](const ChartPoint& p) { return has_media(p) ? text_of(storage_family(), p.knobs.storage) : Json(); }},
    {"rule",
     [](const ChartPoint& p) { return takes_rule(p) ? text_of(in_scattering_family(), p.knobs.rule) : Json(); }},
    {"spp", [](const ChartPoint& p) -> Json { return p.knobs.spp; }},
    {"seconds", [](const ChartPoint& p) -> Json { return p.seconds; }},
    {"seconds_spread", [](const ChartPoint& p) { return p.runs > 1 ? Json(p.seconds_spread) : Json(); }},
    {"build_seconds", [](const ChartPoint& p) -> Json { return p.build_seconds; }},
    {"lookups", [](const ChartPoint& p) -> Json { return static_cast<std::int64_t>(p.lookups); }},
    {"rel_rmse", [](const ChartPoint& p) -> Json { return p.rel_rmse; }},
    {"max_abs", [](const ChartPoint& p) -> Json { return p.max_abs; }},
    {"display", [](const ChartPoint& p) -> Json { return p.display; }},
    {"pareto", [](const ChartPoint& p) -> Json { return p.pareto ? 1 : 0; }},
};

Json point_json(const ChartPoint& point) {
  Json json{{"id", knobs_id(point.knobs)}};
  for (const Column& column : COLUMNS) json[column.name] = column.value(point);
  json["runs"] = point.runs;
  json["error_rank"] = point.error_rank ? Json(*point.error_rank) : Json();
  return json;
}

Json identity_json(const ChartIdentity& i) {
  return {{"scene", i.scene}, {"hash", i.hash},     {"size", i.size},   {"crop", i.crop},       {"spp", i.spp},
          {"seed", i.seed},   {"device", i.device}, {"lanes", i.lanes}, {"generic", i.generic}, {"version", i.version}};
}

Json exact_json(const ChartExact& e) {
  return {{"method", e.method},
          {"spp", e.spp},
          {"seconds", e.seconds},
          {"witness",
           {{"pixels", e.pixels},
            {"gauss_points", e.order},
            {"rel_rmse", e.rel_rmse},
            {"interval95", e.interval},
            {"max_abs", e.max_abs}}}};
}

constexpr int MANY = 2147483647;
const Range SECONDS = Range::at_least_0(), COUNTS = Range::closed(0, 1e300);

template <std::size_t N>
std::array<int, N> integers_read(const JsonValue& value) {
  const std::vector<JsonValue> items = value.as_list();
  if (items.size() != N) value.fail("expected " + std::to_string(N) + " integers" + value.got());
  std::array<int, N> all{};
  for (std::size_t i = 0; i < N; ++i) all[i] = items[i].as_integer(0, MANY);
  return all;
}

// A number, or `fallback` for null.
double number_or(const JsonValue& json, const std::string& key, double fallback, const Range& range) {
  const JsonValue value = json.get(key);
  return value.is_null() ? fallback : value.as_number(range);
}

int member_or(const JsonValue& json, const std::string& key, int fallback, const Family& family) {
  const JsonValue value = json.get(key);
  return value.is_null() ? fallback : value.as_member(family, key.c_str());
}

ChartPoint point_read(const JsonValue& json) {
  ChartPoint p;
  const JsonValue method = json.get("method");
  p.knobs.method = method.as_string() == "none" ? METHOD_NONE : method.as_member(method_family(), "method");
  p.knobs.step = number_or(json, "step", 0, Range::positive());
  p.knobs.tolerance = number_or(json, "tolerance", 0, Range::positive());
  p.knobs.light_grid = static_cast<int>(number_or(json, "light_grid", 0, Range::closed(1, 4096)));
  if (json.has("level")) p.knobs.level = static_cast<int>(number_or(json, "level", 0, Range::closed(1, LEVEL_MAX)));
  p.knobs.storage = member_or(json, "storage", STORAGE_F32, storage_family());
  p.knobs.rule = member_or(json, "rule", IN_SCATTERING_SEGMENT, in_scattering_family());
  p.knobs.spp = json.get("spp").as_integer(1, MANY);
  p.seconds = json.get("seconds").as_number(SECONDS);
  p.seconds_spread = number_or(json, "seconds_spread", 0, SECONDS);
  p.runs = json.get("runs").as_integer(1, MANY);
  if (json.has("error_rank") && !json.get("error_rank").is_null())
    p.error_rank = json.get("error_rank").as_number(Range::closed(-1, 1));
  p.build_seconds = json.get("build_seconds").as_number(SECONDS);
  p.lookups = json.get("lookups").as_number(COUNTS);
  p.rel_rmse = number_or(json, "rel_rmse", 0, COUNTS);
  p.max_abs = number_or(json, "max_abs", 0, COUNTS);
  p.display = json.get("display").as_number(COUNTS);
  return p;
}

ChartIdentity identity_read(const JsonValue& json) {
  ChartIdentity i;
  i.scene = json.get("scene").as_string();
  i.hash = json.get("hash").as_string();
  i.size = integers_read<2>(json.get("size"));
  i.crop = integers_read<4>(json.get("crop"));
  i.spp = json.get("spp").as_integer(1, MANY);
  i.seed = json.get("seed").as_integer(-MANY, MANY);
  i.device = json.get("device").as_string();
  i.lanes = json.get("lanes").as_integer(1, 64);
  const JsonValue generic = json.get("generic");
  if (!generic.json().is_boolean()) generic.fail("expected true or false" + generic.got());
  i.generic = generic.json().get<bool>();
  i.version = json.get("version").as_string();
  return i;
}

ChartExact exact_read(const JsonValue& json) {
  ChartExact e;
  e.method = json.get("method").as_string();
  e.spp = json.get("spp").as_integer(1, MANY);
  e.seconds = json.get("seconds").as_number(SECONDS);
  const JsonValue witness = json.get("witness");
  e.pixels = witness.get("pixels").as_integer(0, MANY);
  e.order = witness.get("gauss_points").as_integer(0, MANY);
  e.rel_rmse = witness.get("rel_rmse").as_number(COUNTS);
  e.max_abs = witness.get("max_abs").as_number(COUNTS);
  const std::vector<JsonValue> ends = witness.get("interval95").as_list();
  if (ends.size() != 2) witness.get("interval95").fail("expected 2 numbers");
  e.interval = {ends[0].as_number(COUNTS), ends[1].as_number(COUNTS)};
  return e;
}

std::string csv_cell(const Json& value) {
  if (value.is_null()) return "";
  if (value.is_string()) return value.get<std::string>();  // names of families need no quotes
  constexpr int DIGITS = 7;
  return value.is_number_float() ? number_text(value.get<double>(), DIGITS) : value.dump();
}

}  // namespace

std::string chart_csv(const Chart& chart) {
  std::string text;
  for (const Column& column : COLUMNS) text += (text.empty() ? "" : ",") + std::string(column.name);
  text += "\n";
  for (const ChartPoint& point : chart.points) {
    std::string line;
    for (const Column& column : COLUMNS) line += (&column == COLUMNS ? "" : ",") + csv_cell(column.value(point));
    text += line + "\n";
  }
  return text;
}

std::string chart_json(const Chart& chart) {
  Json json = identity_json(chart.identity);
  json["exact"] = exact_json(chart.exact);
  json["missing"] = chart.missing;
  json["points"] = Json::array();
  for (const ChartPoint& point : chart.points) json["points"].push_back(point_json(point));
  json["orders"] = Json::array();
  for (const ChartOrder& o : chart.orders)
    json["orders"].push_back(
        {{"method", o.method}, {"knob", o.knob}, {"points", o.points}, {"fitted", o.fitted}, {"expected", o.expected}});
  json["peers"] = Json::array();
  for (const ChartPeer& peer : chart.peers)
    json["peers"].push_back({{"name", peer.name}, {"seconds", peer.seconds}, {"rel_rmse", peer.rel_rmse}});
  return json_line(json, 1) + "\n";
}

Chart chart_read(const std::filesystem::path& file) {
  constexpr std::size_t BYTES_MAX = 64 << 20;
  const nlohmann::json parsed = json_parse(file_read_text(file, BYTES_MAX, "a chart"), file.string());
  const JsonValue json(parsed, file.string());
  Chart chart;
  chart.identity = identity_read(json);
  chart.exact = exact_read(json.get("exact"));
  for (const JsonValue& point : json.get("points").as_list()) chart.points.push_back(point_read(point));
  return chart;
}

}  // namespace brume
