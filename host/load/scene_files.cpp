// See scene_files.hpp.
#include "load/scene_files.hpp"

namespace brume {

namespace {

const DensityDesc& innermost(const DensityDesc& density) { return density.of ? innermost(*density.of) : density; }

void list_density(const DensityDesc& density, SceneFiles& files) {
  if (innermost(density).type != "constant") files.densities.push_back(density);
}

}  // namespace

std::vector<std::filesystem::path> SceneFiles::paths() const {
  std::vector<std::filesystem::path> all;
  for (const DensityDesc& density : densities)
    if (innermost(density).type == "file") all.push_back(innermost(density).file);
  for (const auto* files : {&meshes, &placements, &textures}) all.insert(all.end(), files->begin(), files->end());
  return all;
}

SceneFiles scene_files(const SceneDesc& desc) {
  SceneFiles files;
  for (const MediumDesc& medium : desc.media) {
    list_density(medium.density, files);
    if (medium.emission_density) list_density(*medium.emission_density, files);
  }
  for (const ShapeDesc& shape : desc.shapes) {
    if (const MeshDesc* mesh = std::get_if<MeshDesc>(&shape.geometry)) {
      files.meshes.push_back(mesh->file);
      if (!mesh->instance_file.empty()) files.placements.push_back(mesh->instance_file);
    }
    if (const IsosurfaceDesc* surface = std::get_if<IsosurfaceDesc>(&shape.geometry))
      list_density(*surface->density, files);
  }
  for (const MaterialDesc& material : desc.materials)
    if (material.texture && !material.texture->file.empty()) files.textures.push_back(material.texture->file);
  return files;
}

}  // namespace brume
