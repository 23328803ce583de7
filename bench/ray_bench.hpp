// Rays against triangles: brume's traversal, and Embree's on the same rays and cores.
#pragma once
#include <benchmark/benchmark.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cl/context.hpp"

namespace brume::bench {

// One benchmark: its permanent name and what measures it.
struct RayBench {
  std::string name;
  std::function<void(::benchmark::State&)> measure;
};

// rays/MESH/{build,primary,shadow,bounce}, and with `peers` peer/MESH/embree/…, `repetitions` runs of each: of spot on
// a floor where BRUME_TEST_DATA has it, and within bumpy spheres of 70 000 and of a million triangles. Meshes and rays
// are made when the first that needs them runs.
std::vector<RayBench> ray_benches(const DeviceInfo& device, const std::filesystem::path& folder, int repetitions,
                                  bool peers);

}  // namespace brume::bench
