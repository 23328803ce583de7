// What is measured: a volume seen by one camera under one light, the same for brume and its peers.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "scene/scene_desc.hpp"

namespace brume::bench {

struct Workload {
  std::string name;
  std::filesystem::path file;  // the volume, an OpenVDB file
  double voxel_size;
  SceneDesc desc;  // black background, isotropic phase, one directional light
};

// fog128: a smooth fog of 128³ voxels, a sum of Gaussians, written to `folder`. fog256_sparse: the same fog in eight times
// the volume, the rest of it empty. smoke: BRUME_TEST_DATA/volumes/smoke.vdb where that is there.
std::vector<Workload> workloads(const std::filesystem::path& folder, int size);

}  // namespace brume::bench
