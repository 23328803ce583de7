// brume devices: what OpenCL offers on this machine, and which device is the default.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "cl/device.hpp"
#include "cli/command.hpp"

namespace brume {

namespace {

nlohmann::json device_json(const DeviceInfo& d, bool is_default) {
  return {{"index", d.index},
          {"name", d.name},
          {"platform", d.platform},
          {"version", d.version},
          {"driver", d.driver},
          {"cpu", d.cpu},
          {"compute_units", d.compute_units},
          {"native_float_width", d.float_width},
          {"lanes", d.lanes()},
          {"memory_bytes", d.memory_bytes},
          {"max_buffer_bytes", d.max_buffer_bytes},
          {"default", is_default}};
}

int devices_run(bool json) {
  const std::vector<DeviceInfo> devices = device_list();
  const int chosen = device_choose("").index;
  nlohmann::json all = nlohmann::json::array();
  for (const DeviceInfo& d : devices) {
    all.push_back(device_json(d, d.index == chosen));
    if (json) continue;
    std::printf(
        "%c %d  %s\n     %s, %s, driver %s\n     %d units, float width %d, lanes %d, %.1f GiB, buffers up to %.1f "
        "GiB\n",
        d.index == chosen ? '*' : ' ', d.index, d.name.c_str(), d.platform.c_str(), d.version.c_str(), d.driver.c_str(),
        d.compute_units, d.float_width, d.lanes(), double(d.memory_bytes) / (1 << 30),
        double(d.max_buffer_bytes) / (1 << 30));
  }
  if (json) std::printf("%s\n", all.dump(2).c_str());
  return 0;
}

}  // namespace

void command_devices(CLI::App& app, Command& run) {
  CLI::App* command = app.add_subcommand("devices", "List the OpenCL devices; * marks the default");
  auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "Print JSON");
  command->callback([json, &run] { run = [json] { return devices_run(*json); }; });
}

}  // namespace brume
