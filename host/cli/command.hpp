// One file per command. Each adds its options to the CLI and returns the exit code when it is run.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace brume {

struct ChartPeer;
struct SceneDesc;
class LoadedScene;

using Command = std::function<int()>;

// Other programs on the scene of a chart, for command_chart. In bench/, above all rooms.
struct ChartPeers {
  void (*check)(const SceneDesc&);  // throws InputError for a scene that they cannot render
  // Those that are installed; their pictures go into `folder`.
  std::vector<ChartPeer> (*run)(const SceneDesc&, LoadedScene&, const std::filesystem::path& folder);
};
void chart_peers_check(const SceneDesc& desc);
std::vector<ChartPeer> chart_peers(const SceneDesc& desc, LoadedScene& loaded, const std::filesystem::path& folder);

// Each registers a subcommand on `app`; `run` is set to it when the user names that command.
void command_render(CLI::App& app, Command& run);
void command_chart(CLI::App& app, Command& run, ChartPeers peers);
void command_check(CLI::App& app, Command& run);
void command_devices(CLI::App& app, Command& run);
void command_info(CLI::App& app, Command& run);
void command_compare(CLI::App& app, Command& run);
void command_merge(CLI::App& app, Command& run);
void command_bench(CLI::App& app, Command& run);  // in bench/, above all rooms

}  // namespace brume
