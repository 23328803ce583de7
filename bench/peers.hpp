// Other programs on the same work in the same run.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "image/image.hpp"
#include "workload.hpp"

namespace brume::bench {

struct PeerRun {
  double render_s;   // by its own clock
  double process_s;  // whole process
  std::filesystem::path picture;
};

// vdb_render of libopenvdb-tools: same camera, light and coefficients (its own are per voxel), its default steps, or
// with `converged` steps and cutoff so fine that only its model is left. Nothing where it is not installed.
std::optional<PeerRun> vdb_render_run(const Workload& work, const std::filesystem::path& folder, bool converged);

// Mitsuba 3 (`volpath`, max_depth 2: single scattering) on the same work with 64 samples a pixel, where the Python that
// BRUME_PYTHON names (python3 without) has it; the same renderer twice with other seeds tells how far one picture is
// from its converged self. Nothing where it is not installed.
struct MitsubaRun {
  double render_s;  // by its own clock, without compiling
  std::filesystem::path pictures[2];
};
std::optional<MitsubaRun> mitsuba_run(const Workload& work, const std::filesystem::path& folder);

// VTK's ray caster on the CPU (vtkFixedPointVolumeRayCastMapper, numbers of 15 bits) on a workload that only absorbs,
// in steps of one voxel, where the Python that BRUME_PYTHON names has it. Nothing where it is not installed.
struct VtkRun {
  std::vector<double> seconds;  // of each run, after one that prepares; without showing the picture
  Image transmittance;          // in each channel
};
std::optional<VtkRun> vtk_run(const Workload& work, int threads, int runs, const std::filesystem::path& folder);

// This program as another process on a scene file that is written to `folder`, kernels cached by an earlier run:
// seconds from its start to its end, the picture written. Nothing when it fails.
std::optional<double> brume_process_seconds(const SceneDesc& desc, const std::filesystem::path& folder);

}  // namespace brume::bench
