// See check.hpp: error bookkeeping and the order of the checks.
#include "check/check.hpp"

#include <algorithm>
#include <cmath>

#include "base/interrupt.hpp"
#include "check/check_parts.hpp"

namespace brume {

bool CheckRow::passed() const {
  const double edges_allowed = std::max(1.0, EDGE_SHARE * static_cast<double>(items));
  return items > 0 && max_error <= allowed.limit && static_cast<double>(edges) <= edges_allowed;
}

ErrorSum::ErrorSum(std::string name, int lanes, std::string_view tolerance_name) {
  row_.name = std::move(name);
  row_.lanes = lanes;
  row_.allowed = tolerance(tolerance_name);
}

double ErrorSum::error(double kernel, double reference) const {
  if (kernel == reference) return 0;  // infinities of one sign included
  const double e = std::abs(kernel - reference) / (std::abs(reference) + row_.allowed.floor);
  return std::isfinite(e) ? e : INFINITY;  // a NaN on either side is an infinite error
}

bool ErrorSum::agrees(double kernel, double reference) const { return error(kernel, reference) <= row_.allowed.limit; }

bool ErrorSum::agree(const std::vector<double>& kernel, const std::vector<double>& reference) const {
  return std::equal(kernel.begin(), kernel.end(), reference.begin(), reference.end(),
                    [&](double k, double r) { return agrees(k, r); });
}

void ErrorSum::add(double kernel, double reference) {
  const double e = error(kernel, reference);
  row_.max_error = std::max(row_.max_error, e);
  sum_ += e;
  ++row_.items;
}

CheckRow ErrorSum::row() const {
  CheckRow row = row_;
  row.mean_error = row.items > 0 ? sum_ / static_cast<double>(row.items) : 0;
  if (row.items > 0 && items_ > 0) row.items = items_;  // a row that compared nothing has not passed
  return row;
}

namespace {

std::vector<Check> all_checks() {
  std::vector<Check> all;
  for (const auto list : {basic_checks, material_checks, surface_checks, medium_checks, density_checks, image_checks})
    for (Check& check : list()) all.push_back(std::move(check));
  return all;
}

}  // namespace

std::vector<std::string> check_names() {
  std::vector<std::string> names;
  for (const Check& check : all_checks()) names.push_back(check.name);
  return names;
}

std::vector<CheckRow> check_run(Context& context, const CheckOptions& options,
                                const std::function<void(const CheckRow&)>& report) {
  std::vector<CheckRow> rows;
  for (const Check& check : all_checks()) {
    if (check.name.find(options.filter) == std::string::npos) continue;
    const auto in_name = [&](const std::string& part) { return check.name.find(part) != std::string::npos; };
    if (std::any_of(options.skip.begin(), options.skip.end(), in_name)) continue;
    interrupt_check();
    const CheckCompare compare = check.prepare(options.size);
    for (const int lanes : options.lanes) {
      interrupt_check();
      ErrorSum sum(check.name, lanes, check.tolerance);
      compare(context, lanes, sum);
      rows.push_back(sum.row());
      report(rows.back());
    }
  }
  return rows;
}

}  // namespace brume
