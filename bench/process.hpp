// brume as another process, asked by --stats what it took.
#pragma once
#include <filesystem>
#include <string>

namespace brume::bench {

struct ProcessTimes {
  double build = 0, render = 0;  // seconds
  double pixels = 0, lookups = 0;
};

// `brume render SCENE OPTIONS` with "NAME=value NAME=value" of its environment; what it writes goes to `folder`.
// RuntimeError where it fails.
ProcessTimes process_render(const std::filesystem::path& scene, const std::string& options,
                            const std::string& environment, const std::filesystem::path& folder);

}  // namespace brume::bench
