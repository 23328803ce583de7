// See loaded_scene.hpp.
#include "load/loaded_scene.hpp"

#include <iterator>

#include "base/file_read.hpp"
#include "volume/density_source.hpp"

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
std::size_t array_bytes(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

}  // namespace

std::shared_ptr<Grid> LoadedScene::grid(const DensityDesc& density) {
  const DensitySpec spec = density_spec(density);
  return once(grids_, density_key(spec), [&] { return density_make(spec); });
}

void LoadedScene::keep(const DensityDesc& density, Grid grid) {
  grids_[density_key(density_spec(density))] = std::make_shared<Grid>(std::move(grid));
}

std::shared_ptr<const Mesh> LoadedScene::mesh(const std::filesystem::path& file) {
  return once(meshes_, file_key(file), [&] { return mesh_read_obj(file); });
}

std::shared_ptr<const Image> LoadedScene::texture(const std::filesystem::path& file) {
  return once(textures_, file_key(file), [&] { return image_read_texture(file); });
}

std::vector<LoadedCost> LoadedScene::costs() const {
  std::vector<LoadedCost> costs;
  for (const auto& [key, grid] : grids_) costs.push_back({grid->source, grid->stored_bytes()});
  for (const auto& [file, mesh] : meshes_)
    costs.push_back({file, array_bytes(mesh->positions) + array_bytes(mesh->normals) + array_bytes(mesh->uvs) +
                               array_bytes(mesh->triangles)});
  for (const auto& [file, image] : textures_) costs.push_back({file, array_bytes(image->values)});
  return costs;
}

}  // namespace brume
