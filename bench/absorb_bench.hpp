// A medium that only absorbs, before a white background: brume, and VTK's ray caster on the same work.
#pragma once
#include <filesystem>
#include <vector>

#include "cl/device.hpp"
#include "runs.hpp"
#include "workload.hpp"

namespace brume::bench {

// absorb/WORK/METHOD, and with `peers` peer/WORK/vtk, `repetitions` runs of each by what has rendered once before.
std::vector<Bench> absorb_benches(const DeviceInfo& device, const Workload& work, const std::filesystem::path& folder,
                                  int repetitions, bool peers);

}  // namespace brume::bench
