// See compare.hpp.
#include "compare.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "base/error.hpp"
#include "base/statistics.hpp"

namespace brume::bench {

namespace {

// Pictures are the same from run to run, but for rounding.
constexpr double ERROR_CHANGE = 0.02, ERROR_ROUNDING = 1e-6;

struct Compared {
  const Row *before, *after;
  Change change;
};

bool error_changed(const Row& before, const Row& after) {
  const double a = before.counter("rel_rmse"), b = after.counter("rel_rmse");
  return std::abs(a - b) > std::max(ERROR_CHANGE * std::max(a, b), ERROR_ROUNDING);
}

std::string change_text(double log_ratio) {
  char text[40];
  std::snprintf(text, sizeof text, "%+.1f %%", 100 * (std::exp(log_ratio) - 1));
  return text;
}

std::string verdict_of(const Compared& row) {
  std::string verdict;
  if (row.change.exceeds()) verdict = row.change.ratio < 1 ? "quicker" : "slower";
  if (error_changed(*row.before, *row.after)) {
    const double a = row.before->counter("rel_rmse"), b = row.after->counter("rel_rmse");
    verdict += (verdict.empty() ? "" : ", ") + std::string(b < a ? "closer" : "further off") + ": " + error_text(a) +
               " to " + error_text(b);
  }
  return verdict;
}

std::vector<Compared> compared(const Results& before, const Results& after) {
  std::vector<Compared> rows;
  std::vector<TimesPair> pairs;
  for (const Row& row : before.rows) {
    const Row* other = after.find(row.name);
    if (!other || row.seconds.empty() || other->seconds.empty()) continue;
    rows.push_back({&row, other, {}});
    pairs.push_back({row.seconds, other->seconds});
  }
  const std::vector<Change> changes = changes_of(pairs);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].change = changes[i];
  return rows;
}

std::string line_of(const std::string& name, std::size_t width, const std::array<std::string, 4>& cells) {
  std::string line = column(name, -int(width));
  for (const std::string& cell : cells) line += column(cell, 12);
  return line;
}

std::string row_line(const Compared& row, const std::string& verdict, std::size_t width) {
  return line_of(row.before->name, width,
                 {seconds_text(quantile(row.before->seconds, 0.5)), seconds_text(quantile(row.after->seconds, 0.5)),
                  change_text(std::log(row.change.ratio)),
                  row.change.noise ? share_text(std::exp(*row.change.noise) - 1) : "unknown"}) +
         "  " + verdict + "\n";
}

// What both were measured on, where that differs.
std::string differences(const Results& before, const Results& after) {
  std::string text;
  const auto say = [&](const char* what, const std::string& a, const std::string& b) {
    if (a != b) text += std::string(what) + " " + a + " and " + b + "\n";
  };
  say("versions", before.version, after.version);
  say("devices", before.device, after.device);
  say("drivers", before.driver, after.driver);
  say("lanes", std::to_string(before.lanes), std::to_string(after.lanes));
  return text;
}

std::string only_in(const char* which, const Results& its, const Results& other) {
  std::string names;
  for (const Row& row : its.rows)
    if (!other.find(row.name)) names += (names.empty() ? "" : ", ") + row.name;
  return names.empty() ? "" : "only in " + std::string(which) + ": " + names + "\n";
}

}  // namespace

std::string results_compare(const Results& before, const Results& after) {
  if (before.size != after.size)
    throw InputError("--compare: pictures of " + std::to_string(before.size) + " and " + std::to_string(after.size) +
                     " pixels a side cannot be compared");
  const std::vector<Compared> rows = compared(before, after);
  if (rows.empty()) throw InputError("--compare: the two have no benchmark in common");
  std::size_t width = 9, quicker = 0, slower = 0;
  std::vector<double> ratios;
  for (const Compared& row : rows) {
    width = std::max(width, row.before->name.size());
    (row.change.ratio < 1 ? quicker : slower) += row.change.exceeds();
    ratios.push_back(row.change.ratio);
  }
  std::string table;
  for (const Compared& row : rows)
    if (const std::string verdict = verdict_of(row); !verdict.empty()) table += row_line(row, verdict, width);
  if (!table.empty()) table = line_of("benchmark", width, {"before", "after", "change", "noise"}) + "\n" + table;
  const std::string counts = std::to_string(quicker) + " quicker, " + std::to_string(slower) + " slower, " +
                             std::to_string(rows.size() - quicker - slower) +
                             " within their noise; the median of all changes is " +
                             change_text(std::log(quantile(ratios, 0.5))) + "\n";
  return differences(before, after) + table + counts + only_in("the first", before, after) +
         only_in("the second", after, before);
}

}  // namespace brume::bench
