// What it is worth that kernels know their scene: the same pictures by specialised and by generic kernels.
#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace brume::bench {

// Seconds, of processes of their own.
struct KernelTimes {
  double cold = 0, warm = 0;  // to build the kernels: nobody did before; the driver has kept them
  double render = 0;          // of the picture, median
};

struct SpecialisedRow {
  std::filesystem::path scene;
  double pixels = 0;
  KernelTimes specialised, generic;

  // From how many pixels on it is sooner to build specialised kernels than to take generic ones that are there already;
  // nothing where it never is.
  std::optional<double> break_even() const;
};

struct SpecialisedOptions {
  std::string device;
  int size = 0;         // pixels a side; 0: as the scene says
  int repetitions = 3;  // after the cold one
};

// A row of each scene, reported as it is finished. `folder` takes caches and pictures. Cold builds are those of PoCL,
// whose cache is POCL_CACHE_DIR. RuntimeError where a render fails.
std::vector<SpecialisedRow> specialised_run(const std::vector<std::filesystem::path>& scenes,
                                            const SpecialisedOptions& options, const std::filesystem::path& folder,
                                            const std::function<void(const SpecialisedRow&)>& report);

std::string specialised_header();
std::string specialised_text(const SpecialisedRow& row);
std::string specialised_legend();
std::string specialised_json(const std::vector<SpecialisedRow>& rows);

}  // namespace brume::bench
