// See row.hpp.
#include "row.hpp"

#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/file_read.hpp"
#include "base/json_text.hpp"
#include "base/json_value.hpp"
#include "base/statistics.hpp"
#include "base/text_printable.hpp"

namespace brume::bench {

namespace {

constexpr std::size_t FILE_BYTES_MAX = 64 << 20;

// Three digits and no exponent: "0.031", "4.93", "1230".
std::string digits_text(double value) {
  char text[40];
  const int decimals = value >= 100 ? 0 : (value >= 10 ? 1 : 2);
  std::snprintf(text, sizeof text, "%.*f", value < 0.1 ? 3 : decimals, value);
  return text;
}

Row row_read(const JsonValue& json) {
  json.expect_object();
  Row row;
  row.name = text_printable(json.get("name").as_string());
  for (const JsonValue& seconds : json.list("seconds")) row.seconds.push_back(seconds.as_number(Range::positive()));
  for (const auto& [key, value] : json.json().items())
    if (value.is_number() && key != "median" && key != "spread")
      row.counters[key] = json.get(key).as_number(Range::any());
  if (json.has("failure")) row.failure = text_printable(json.get("failure").as_string());
  return row;
}

}  // namespace

double Row::counter(const std::string& key, double fallback) const {
  const auto found = counters.find(key);
  return found == counters.end() ? fallback : found->second;
}

const Row* Results::find(const std::string& name) const {
  for (const Row& row : rows)
    if (row.name == name) return &row;
  return nullptr;
}

std::string results_json(const Results& results) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const Row& row : results.rows) {
    const Summary summary = summary_of(row.seconds);
    nlohmann::ordered_json json{{"name", row.name}};
    if (row.failure.empty())
      json.update({{"median", summary.median}, {"spread", summary.spread}, {"seconds", row.seconds}});
    else
      json["failure"] = row.failure;
    for (const auto& [key, value] : row.counters) json[key] = value;
    rows.push_back(json);
  }
  return json_text({{"version", results.version},
                    {"device", results.device},
                    {"driver", results.driver},
                    {"units", results.units},
                    {"lanes", results.lanes},
                    {"size", results.size},
                    {"benchmarks", rows}});
}

Results results_read(const std::filesystem::path& file) {
  const nlohmann::json json =
      json_parse(file_read_text(file, FILE_BYTES_MAX, "a result of brume bench"), file.string());
  const JsonValue value(json, file.string());
  value.expect_object();
  for (const char* key : {"version", "device", "driver", "units", "lanes", "size", "benchmarks"})
    if (!value.has(key)) value.fail(std::string("no result of brume bench: it has no '") + key + "'");
  Results results{text_printable(value.get("version").as_string()),
                  text_printable(value.get("device").as_string()),
                  text_printable(value.get("driver").as_string()),
                  value.integer("units", 0, 1, 1 << 20),
                  value.integer("lanes", 0, 1, 16),
                  value.integer("size", 0, 1, 1 << 20),
                  {}};
  for (const JsonValue& row : value.list("benchmarks")) results.rows.push_back(row_read(row));
  return results;
}

std::string seconds_text(double seconds) {
  return seconds >= 1 ? digits_text(seconds) + " s" : digits_text(1e3 * seconds) + " ms";
}

std::string share_text(double share) { return digits_text(100 * share) + " %"; }

std::string error_text(double rel_rmse) {
  if (rel_rmse == 0) return "exact";
  return rel_rmse < 1e-5 ? "< 0.001 %" : share_text(rel_rmse);
}

std::string rate_text(double per_second) {
  return per_second >= 1e9 ? digits_text(1e-9 * per_second) + " G/s" : digits_text(1e-6 * per_second) + " M/s";
}

std::string column(const std::string& text, int width) {
  const std::size_t wanted = static_cast<std::size_t>(std::abs(width));
  const std::string room(wanted > text.size() ? wanted - text.size() : 0, ' ');
  return width < 0 ? text + room : room + text;
}

std::string rows_header(std::size_t width) {
  return column("benchmark", -int(width)) + "  runs      median    spread   lookups/s       error\n";
}

std::string row_text(const Row& row, std::size_t width) {
  const std::string name = column(row.name, -int(width)) + "  ";
  if (!row.failure.empty()) return name + row.failure + "\n";
  const Summary summary = summary_of(row.seconds);
  const double lookups = row.counter("lookups", row.counter("rays"));
  const bool has_error = row.counters.count("rel_rmse") > 0;
  return name + column(std::to_string(row.seconds.size()), 4) + column(seconds_text(summary.median), 12) +
         column(row.seconds.size() > 1 ? share_text(summary.spread / summary.median) : "-", 10) +
         column(lookups > 0 ? rate_text(lookups / summary.median) : "-", 12) +
         column(has_error ? error_text(row.counter("rel_rmse")) : "-", 12) + "\n";
}

std::string rows_legend() {
  return "\n"
         "median, spread  seconds of a run, and half of what lies between the quartiles (fewer than five runs: the "
         "ends)\n"
         "lookups/s       of density along view rays and light rays; those that fill light grids are not counted\n"
         "error           relative RMSE against the exact picture of the workload; of vdb_render and Mitsuba against\n"
         "                the picture that each converges to\n"
         "render/         one whole render, without reading files and building kernels\n"
         "absorb/         the same of a medium that only absorbs, before white; peer/…/vtk is the same work\n"
         "scene/          one whole render of a scene file; error against its picture by steps of a sixteenth\n"
         "rays/           triangles: rays on lookups/s; build: the BVH. peer/…/embree/: the quickest of its calls on "
         "the same rays\n"
         "process/        a whole brume from start to end, kernels cached, the picture written\n";
}

}  // namespace brume::bench
