// brume check: kernels against the scalar reference on one device, as a table; exit 1 on a miss.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/streams.hpp"
#include "check/check.hpp"
#include "cli/command.hpp"
#include "stability/stability.hpp"

namespace brume {

namespace {

struct CheckArguments {
  std::string device;
  std::filesystem::path json;
  std::vector<int> lanes;
  CheckOptions options;
  bool stability = false;
};

void print_row(const CheckRow& row) {
  std::printf("%-4s %-34s %5d %8zu %6zu  %9.2e  %9.2e  %7.0e\n", row.passed() ? "ok" : "MISS", row.name.c_str(),
              row.lanes, row.items, row.edges, row.max_error, row.mean_error, row.allowed.limit);
  stdout_flush();
}

void print_reasons() {
  std::printf("\nerror = |kernel - reference| / (|reference| + floor)\n");
  for (const Tolerance& t : TOLERANCES)
    std::printf("  %-9.*s %7.0e, floor %-5g %.*s\n", int(t.name.size()), t.name.data(), t.limit, t.floor,
                int(t.reason.size()), t.reason.data());
  std::printf("  edges: rays with another surface or shadow, or that hang on their last digits; allowed %g of a row\n",
              EDGE_SHARE);
}

nlohmann::ordered_json rows_json(const DeviceInfo& device, const std::vector<CheckRow>& rows) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const CheckRow& r : rows)
    list.push_back({{"name", r.name},
                    {"lanes", r.lanes},
                    {"items", r.items},
                    {"edges", r.edges},
                    {"max_error", r.max_error},
                    {"mean_error", r.mean_error},
                    {"tolerance", r.allowed.limit},
                    {"floor", r.allowed.floor},
                    {"reason", r.allowed.reason},
                    {"passed", r.passed()}});
  return {{"device", device.title()}, {"version", device.version}, {"driver", device.driver}, {"rows", list}};
}

int check_command(CheckArguments arguments) {
  if (!arguments.json.empty()) AtomicFile probe(arguments.json);  // not after minutes
  const DeviceInfo device = device_choose(arguments.device);
  if (!arguments.lanes.empty()) arguments.options.lanes = arguments.lanes;
  Context context(device);
  std::printf("%s, %s, driver %s\n\n", device.title().c_str(), device.version.c_str(), device.driver.c_str());
  std::printf("     %-34s lanes    items  edges  max error mean error  allowed\n", "check");
  const std::vector<CheckRow> rows = check_run(context, arguments.options, print_row);
  if (rows.empty()) throw InputError("--filter: no check matches '" + arguments.options.filter + "'");
  std::size_t missed = 0;
  for (const CheckRow& row : rows) missed += !row.passed();
  print_reasons();
  std::printf("%zu checks, %zu missed\n", rows.size(), missed);
  if (!arguments.json.empty()) atomic_write(arguments.json, rows_json(device, rows).dump(2) + "\n");
  return missed > 0 ? 1 : 0;
}

void print_stability(const StabilityRow& row) {
  std::printf("%-4s %-16s %-22s %5d  %s\n", row.holds ? "ok" : "FAIL", row.name.c_str(), row.method.c_str(), row.lanes,
              row.remark.c_str());
  stdout_flush();
}

nlohmann::ordered_json stability_json(const DeviceInfo& device, const std::vector<StabilityRow>& rows) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const StabilityRow& r : rows)
    list.push_back(
        {{"case", r.name}, {"method", r.method}, {"lanes", r.lanes}, {"holds", r.holds}, {"remark", r.remark}});
  return {{"device", device.title()}, {"version", device.version}, {"driver", device.driver}, {"rows", list}};
}

int stability_command(const CheckArguments& arguments) {
  if (!arguments.json.empty()) AtomicFile probe(arguments.json);
  const DeviceInfo device = device_choose(arguments.device);
  Context context(device);
  std::printf("%s, %s, driver %s\n\n", device.title().c_str(), device.version.c_str(), device.driver.c_str());
  for (const StabilityCase& c : stability_cases()) std::printf("%-16s %s\n", c.name, c.what);
  std::printf("\n     %-16s %-22s lanes\n", "case", "method");
  StabilityOptions options;
  options.filter = arguments.options.filter;
  if (!arguments.lanes.empty()) options.lanes = arguments.lanes;
  const std::vector<StabilityRow> rows = check_stability(context, options, print_stability);
  if (rows.empty()) throw InputError("--filter: no case matches '" + options.filter + "'");
  const auto failed = std::count_if(rows.begin(), rows.end(), [](const StabilityRow& r) { return !r.holds; });
  std::printf("%zu rows, %td failed\n", rows.size(), failed);
  if (!arguments.json.empty()) atomic_write(arguments.json, stability_json(device, rows).dump(2) + "\n");
  return failed > 0 ? 1 : 0;
}

}  // namespace

void command_check(CLI::App& app, Command& run) {
  CLI::App* command = app.add_subcommand("check", "Compare the kernels on a device with the scalar reference");
  auto arguments = std::make_shared<CheckArguments>();
  command->add_option("--device", arguments->device, "Index or part of the name of an OpenCL device");
  command->add_option("--lanes", arguments->lanes, "Only these lane widths")
      ->check(CLI::IsMember({1, 4, 8, 16}))
      ->delimiter(',');
  command->add_option("--size", arguments->options.size, "Pixels per side of the pictures")->check(CLI::Range(4, 1024));
  command->add_option("--filter", arguments->options.filter, "Only checks whose name contains this");
  command->add_option("--skip", arguments->options.skip, "Not those whose name contains one of these")->delimiter(',');
  command->add_flag("--stability", arguments->stability,
                    "Instead: every method on cases that are known to break volume renderers");
  command->add_option("--json", arguments->json, "Write the table as JSON");
  command->callback([arguments, &run] {
    run = [arguments] { return arguments->stability ? stability_command(*arguments) : check_command(*arguments); };
  });
}

}  // namespace brume
