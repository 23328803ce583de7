// The benchmarks, on Google Benchmark; times are those of whole renders without kernel builds.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "cl/device.hpp"
#include "row.hpp"
#include "workload.hpp"

namespace brume::bench {

struct BenchOptions {
  std::string filter = ".";  // a regular expression
  int repetitions = 3;       // of light that is traced, which takes seconds to minutes, a third of them
  bool peers = false;
};

// Runs those whose names match; `begin` is called before the first, `report` with every row as it is finished.
std::vector<Row> benchmarks_run(const DeviceInfo& device, const std::vector<Workload>& workloads,
                                const BenchOptions& options, const std::filesystem::path& folder,
                                const std::function<void()>& begin, const std::function<void(const Row&)>& report);

}  // namespace brume::bench
