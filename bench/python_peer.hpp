// Programs that are modules of Python: their work as JSON beside raw densities, the rest in a script of their own.
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "workload.hpp"

namespace brume::bench {

// Whether the Python that BRUME_PYTHON names (python3 without) has these modules, "mitsuba, numpy".
bool python_has(const std::string& modules);

// The volume, written to `folder`, camera and film of a workload: densities, size, lo, hi, eye, target, up, vfov, film.
nlohmann::json python_work(const Workload& work, const std::filesystem::path& folder);

// Runs the script on such a work with whatever else it wants; the numbers of the last line that it prints, none where
// it fails.
std::vector<double> python_run(const std::string& name, const char* script, const nlohmann::json& work,
                               const std::filesystem::path& folder);

}  // namespace brume::bench
