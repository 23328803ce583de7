// See process.hpp.
#include "process.hpp"

#include <nlohmann/json.hpp>

#include "base/command_line.hpp"
#include "base/error.hpp"
#include "base/file_read.hpp"

namespace brume::bench {

ProcessTimes process_render(const std::filesystem::path& scene, const std::string& options,
                            const std::string& environment, const std::filesystem::path& folder) {
  const std::filesystem::path statistics = folder / "process.stats.json";
  const std::string command = environment + " " + shell_quoted(std::filesystem::read_symlink("/proc/self/exe")) +
                              " render " + shell_quoted(scene) + " --quiet --witness 0 --stats " +
                              shell_quoted(statistics) + " -o " + shell_quoted(folder / "process.exr") + " " + options;
  if (!command_succeeds(command + " >/dev/null")) throw RuntimeError(scene.string() + ": was not rendered");
  const nlohmann::json one = nlohmann::json::parse(file_read_text(statistics, 1 << 20, "statistics of a render"));
  return {one["kernel_build_s"], one["render_s"], one["size"][0].get<double>() * one["size"][1].get<double>(),
          one["lookups"]};
}

}  // namespace brume::bench
