// What a scene's description names and has to be loaded: one list for whoever loads ahead, keeps what another frame
// shares, or asks whether all of it is there.
#pragma once
#include <filesystem>
#include <vector>

#include "scene/scene_desc.hpp"

namespace brume {

struct SceneFiles {
  std::vector<DensityDesc> densities;  // but constants: most methods need no grid of those
  std::vector<std::filesystem::path> meshes, placements, textures;

  std::vector<std::filesystem::path> paths() const;  // of all that are files, without those that these name
};

SceneFiles scene_files(const SceneDesc& desc);

}  // namespace brume
