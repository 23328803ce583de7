// See loaded_scene.hpp.
#include "load/loaded_scene.hpp"

#include <iterator>

#include "base/file_read.hpp"
#include "load/scene_files.hpp"
#include "volume/density_source.hpp"
#include "volume/grid_level.hpp"

namespace brume {

namespace {

DensitySpec density_spec(const DensityDesc& d) {
  DensitySpec spec;
  spec.type = d.type;
  spec.resolution = d.resolution;
  spec.value = d.value;
  spec.scale = d.scale;
  spec.octaves = d.octaves;
  spec.seed = d.seed;
  spec.file = d.file;
  spec.grid = d.grid;
  spec.values = {d.level_set == LEVEL_SET_FILL, d.threshold, d.remap, d.factor, d.negative == NEGATIVE_CLAMP};
  spec.radius = d.radius;
  spec.ramp = d.ramp;
  constexpr Presence PRESENCES[] = {Presence::REFUSE, Presence::SCALE, Presence::CLAMP};
  static_assert(std::size(PRESENCES) == PRESENCE_COUNT, "in the order of BRUME_PRESENCE_RULES");
  if (d.presence) spec.presence = PRESENCES[*d.presence];
  if (d.of) spec.of = std::make_shared<DensitySpec>(density_spec(*d.of));
  return spec;
}

// What `known` has under the key, else what `load` makes.
template <class T, class Load>
std::shared_ptr<T> once(std::map<std::string, std::shared_ptr<T>>& known, const std::string& key, Load load) {
  const auto found = known.find(key);
  if (found != known.end()) return found->second;
  return known[key] = std::make_shared<T>(load());
}

template <class T>
void share(const std::map<std::string, T>& from, const std::string& key, std::map<std::string, T>& to) {
  if (const auto found = from.find(key); found != from.end()) to.insert(*found);
}

template <class T>
std::size_t array_bytes(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

}  // namespace

std::shared_ptr<Grid> LoadedScene::grid(const DensityDesc& density, int level) {
  const DensitySpec spec = density_spec(density);
  const std::string key = density_key(spec);
  if (level == 0) return once(grids_, key, [&] { return density_make(spec); });
  return once(grids_, key + " level " + std::to_string(level), [&] { return grid_halved(*grid(density, level - 1)); });
}

void LoadedScene::keep(const DensityDesc& density, Grid grid) {
  grids_[density_key(density_spec(density))] = std::make_shared<Grid>(std::move(grid));
}

std::shared_ptr<const Mesh> LoadedScene::mesh(const std::filesystem::path& file) {
  return once(meshes_, file_key(file), [&] { return mesh_read(file); });
}

void LoadedScene::keep(const std::filesystem::path& file, Mesh mesh) {
  meshes_[file_key(file)] = std::make_shared<const Mesh>(std::move(mesh));
}

std::shared_ptr<const std::vector<MeshPlacement>> LoadedScene::placements(const std::filesystem::path& file) {
  return once(placements_, file_key(file), [&] { return placements_read(file); });
}

std::shared_ptr<const Image> LoadedScene::texture(const std::filesystem::path& file) {
  return once(textures_, file_key(file), [&] { return image_read_texture(file); });
}

LoadedScene LoadedScene::shared_with(const SceneDesc& desc) const {
  const SceneFiles files = scene_files(desc);
  LoadedScene shared;
  for (const DensityDesc& density : files.densities) share(grids_, density_key(density_spec(density)), shared.grids_);
  for (const std::filesystem::path& file : files.meshes) share(meshes_, file_key(file), shared.meshes_);
  for (const std::filesystem::path& file : files.placements) share(placements_, file_key(file), shared.placements_);
  for (const auto& [key, mesh] : shared.meshes_)  // which name textures, too
    for (const MeshMaterial& material : mesh->materials)
      for (const MeshTexture* texture : {&material.texture, &material.emission_texture})
        if (!texture->file.empty()) share(textures_, file_key(texture->file), shared.textures_);
  for (const std::filesystem::path& file : files.textures) share(textures_, file_key(file), shared.textures_);
  return shared;
}

std::vector<LoadedCost> LoadedScene::costs() const {
  std::vector<LoadedCost> costs;
  for (const auto& [key, grid] : grids_) costs.push_back({grid->source, grid->stored_bytes()});
  for (const auto& [file, mesh] : meshes_)
    costs.push_back({file, array_bytes(mesh->positions) + array_bytes(mesh->normals) + array_bytes(mesh->uvs) +
                               array_bytes(mesh->triangles)});
  for (const auto& [file, placements] : placements_) costs.push_back({file, array_bytes(*placements)});
  for (const auto& [file, image] : textures_) costs.push_back({file, array_bytes(image->values)});
  return costs;
}

}  // namespace brume
