// What the files of a scene hold, read once however often it is named: the volumes as grids, the meshes in their own
// space, the textures as texels. Knows no units, no methods and no picture; another description of the same files finds
// what is here.
#pragma once
#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "image/image.hpp"
#include "mesh/mesh.hpp"
#include "mesh/placements.hpp"
#include "scene/scene_desc.hpp"
#include "volume/grid.hpp"

namespace brume {

// One thing that was loaded.
struct LoadedCost {
  std::string what;       // the file, or the name of a generator
  std::size_t bytes = 0;  // in memory
};

class LoadedScene {
 public:
  // Each is loaded when it is first asked for. They throw what their readers throw: InputError.
  // level: of detail; what it is averaged from stays, too.
  std::shared_ptr<Grid> grid(const DensityDesc& density, int level = 0);
  std::shared_ptr<const Mesh> mesh(const std::filesystem::path& file);
  std::shared_ptr<const std::vector<MeshPlacement>> placements(const std::filesystem::path& file);
  std::shared_ptr<const Image> texture(const std::filesystem::path& file);

  // A grid that was read already, as that density; a mesh, as that file.
  void keep(const DensityDesc& density, Grid grid);
  void keep(const std::filesystem::path& file, Mesh mesh);

  // Of what was loaded, that which `desc` names too, for another frame of a sequence.
  LoadedScene shared_with(const SceneDesc& desc) const;

  std::vector<LoadedCost> costs() const;

  // Whoever flattens it for the last time: grids may then give their memory back as they are laid out.
  bool needed_again = true;

 private:
  std::map<std::string, std::shared_ptr<Grid>> grids_;  // by density_key
  std::map<std::string, std::shared_ptr<const Mesh>> meshes_;
  std::map<std::string, std::shared_ptr<const std::vector<MeshPlacement>>> placements_;
  std::map<std::string, std::shared_ptr<const Image>> textures_;
};

}  // namespace brume
