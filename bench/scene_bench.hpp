// Whole scene files as benchmarks: one render each, held against the same with finer steps.
#pragma once
#include <benchmark/benchmark.h>

#include <filesystem>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "cl/device.hpp"

namespace brume::bench {

struct SceneCase {
  std::string name;
  std::filesystem::path file;
  std::vector<std::string> overrides;
};
// Those that are there, from the folder of the source.
std::vector<SceneCase> scene_cases();

void scene_benchmark(::benchmark::State& state, const DeviceInfo& device, const SceneCase& scene, glm::ivec2 size);

}  // namespace brume::bench
