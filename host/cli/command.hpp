// One file per command. Each adds its options to the CLI and returns the exit code when it is run.
#pragma once
#include <functional>
#include <string>

namespace CLI {
class App;
}

namespace brume {

using Command = std::function<int()>;

// Each registers a subcommand on `app`; `run` is set to it when the user names that command.
void command_render(CLI::App& app, Command& run);
void command_chart(CLI::App& app, Command& run);
void command_check(CLI::App& app, Command& run);
void command_devices(CLI::App& app, Command& run);
void command_info(CLI::App& app, Command& run);
void command_compare(CLI::App& app, Command& run);
void command_merge(CLI::App& app, Command& run);
void command_bench(CLI::App& app, Command& run);  // in bench/, above all rooms

}  // namespace brume
