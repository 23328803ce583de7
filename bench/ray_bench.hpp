// Rays against triangles: brume's traversal, and Embree's on the same rays and cores.
#pragma once
#include <filesystem>
#include <vector>

#include "cl/context.hpp"
#include "runs.hpp"

namespace brume::bench {

// rays/MESH/{build,primary,shadow,bounce}, and with `peers` peer/MESH/embree/…, `repetitions` runs of each: of spot on
// a floor where BRUME_TEST_DATA has it, and within bumpy spheres of 70 000 and of a million triangles. Meshes and rays
// are made when the first that needs them runs.
std::vector<Bench> ray_benches(const DeviceInfo& device, const std::filesystem::path& folder, int repetitions,
                               bool peers);

}  // namespace brume::bench
