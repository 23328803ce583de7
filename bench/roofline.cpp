// See roofline.hpp.
#include "roofline.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/number_text.hpp"
#include "base/statistics.hpp"
#include "cl/context.hpp"
#include "cl/driver_guard.hpp"
#include "render/renderer.hpp"
#include "roofline_parts.hpp"

namespace brume::bench {

namespace {

// What a rate of the device is called, and how much of it an item takes.
struct Limit {
  const char *name, *counter;
  double Cost::*part;
};
constexpr Limit LIMITS[] = {
    {"copy", "item_bytes", &Cost::bytes}, {"fma", "item_flops", &Cost::flops}, {"loads", "item_loads", &Cost::loads}};

// Of the device, the best of the runs: rows before are the limits themselves.
double limit_rate(const std::vector<RooflineRow>& rows, const std::string& name) {
  for (const RooflineRow& row : rows)
    if (row.row.name == "limit/" + name)
      return row.row.counter("items") / *std::min_element(row.row.seconds.begin(), row.row.seconds.end());
  return INFINITY;
}

// Holds a row against the limits.
void row_finish(RooflineRow& row, const std::vector<RooflineRow>& limits) {
  row.rate = row.row.counter("items") / summary_of(row.row.seconds).median;
  row.allowed = INFINITY;
  for (const Limit& limit : LIMITS) {
    const double part = row.cost.*limit.part, allowed = limit_rate(limits, limit.name) / part;
    row.row.counters[limit.counter] = part;
    if (part > 0 && allowed < row.allowed) {
      row.allowed = allowed;
      row.limit = limit.name;
    }
  }
  row.row.counters["share"] = row.rate / row.allowed;
}

}  // namespace

std::vector<RooflineRow> roofline_run(const DeviceInfo& device, const RooflineOptions& options,
                                      const std::filesystem::path& folder,
                                      const std::function<void(const RooflineRow&)>& report) {
  Context context(device);
  const Workload fog = fog_workload(folder, options.size);
  std::vector<RooflineRow> rows;
  const auto add = [&](const std::string& name, const std::string& item, double items,
                       const std::vector<double>& seconds, const Cost& cost) {
    rows.push_back({{name, seconds, {{"items", items}}, ""}, item, cost, 0, 0, ""});
    row_finish(rows.back(), rows);
    report(rows.back());
  };
  const RooflineBench bench{context, fog, lanes_choose(device, 0), options, folder, add};
  const DriverGuard guard;
  bumpy_sphere_write(160, folder / "sphere.obj");
  try {
    for (const auto part : {roofline_kernels, roofline_lookups, roofline_rays, roofline_picture, roofline_host})
      part(bench);
  } catch (const cl::Error& error) {
    throw RuntimeError(device.title() + ": roofline: " + error.what() + " failed: " + cl_error_name(error.err()));
  }
  return rows;
}

std::string roofline_header() {
  return column("measured", -30) + column("a second", 12) + column("of", 13) + column("spread", 10) +
         column("bytes", 8) + column("flops", 8) + column("loads", 7) + column("allowed", 12) + column("by", 7) +
         column("share", 9) + "\n";
}

std::string roofline_text(const RooflineRow& row) {
  const Summary summary = summary_of(row.row.seconds);
  const auto number = [](double value) { return value > 0 ? number_text(value, value < 1000 ? 3 : 4) : "-"; };
  return column(row.row.name, -30) + column(rate_text(row.rate), 12) + column(row.item, 13) +
         column(row.row.seconds.size() > 1 ? share_text(summary.spread / summary.median) : "-", 10) +
         column(number(row.cost.bytes), 8) + column(number(row.cost.flops), 8) + column(number(row.cost.loads), 7) +
         column(rate_text(row.allowed), 12) + column(row.limit, 7) + column(share_text(row.row.counter("share")), 9) +
         "\n";
}

std::string roofline_legend(const std::vector<RooflineRow>& rows) {
  std::string text = "\nWhat an item costs at least:\n";
  std::string before;
  for (const RooflineRow& row : rows) {
    const std::string& because = row.cost.because;
    if (because != before) text += column(row.row.name, -30) + because + "\n";
    before = because;
  }
  return text +
         "\n"
         "bytes    to and from memory, where caches keep whatever is used again\n"
         "flops    an fma is two\n"
         "loads    from places that differ by lane, of a number or of two neighbours\n"
         "allowed  the rate at which the device, at its own speed of copying, multiplying or loading, could do no "
         "more\n";
}

}  // namespace brume::bench
