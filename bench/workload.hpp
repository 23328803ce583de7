// What is measured: a volume seen by one camera under one light, the same for brume and its peers.
#pragma once
#include <filesystem>
#include <glm/geometric.hpp>
#include <memory>
#include <string>
#include <vector>

#include "load/loaded_scene.hpp"
#include "scene/scene_desc.hpp"

namespace brume::bench {

struct Workload {
  std::string name;
  std::filesystem::path file;           // the volume, an OpenVDB file
  std::shared_ptr<LoadedScene> loaded;  // the volume, read once for all measurements
  SceneDesc desc;                       // black background, isotropic phase, one directional light

  const Grid& grid() const { return *loaded->grid(desc.media[0].density); }
  double voxel_size() const { return glm::length(glm::dvec3(grid().world_from_lattice[0])); }
};

// fog128: a smooth fog of 128³ voxels, a sum of Gaussians, written to `folder`. fog256_sparse: the same fog in eight
// times the volume, the rest of it empty. smoke: BRUME_TEST_DATA/volumes/smoke.vdb where that is there.
Workload fog_workload(const std::filesystem::path& folder, int size);  // the first alone
std::vector<Workload> workloads(const std::filesystem::path& folder, int size);

}  // namespace brume::bench
