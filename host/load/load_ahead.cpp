// See load_ahead.hpp.
#include "load/load_ahead.hpp"

#include <exception>
#include <functional>
#include <vector>

namespace brume {

namespace {

using Load = std::function<void(LoadedScene&)>;

void list_density(const DensityDesc& density, std::vector<Load>& loads) {
  const DensityDesc* inner = &density;
  while (inner->of) inner = inner->of.get();
  if (inner->type == "constant") return;  // most methods need no grid of it
  loads.emplace_back([density](LoadedScene& loaded) { loaded.grid(density); });
}

std::vector<Load> loads_of(const SceneDesc& desc) {
  std::vector<Load> loads;
  for (const MediumDesc& medium : desc.media) {
    list_density(medium.density, loads);
    if (medium.emission_density) list_density(*medium.emission_density, loads);
  }
  for (const ShapeDesc& shape : desc.shapes) {
    if (const MeshDesc* mesh = std::get_if<MeshDesc>(&shape.geometry))
      loads.emplace_back([file = mesh->file](LoadedScene& loaded) { loaded.mesh(file); });
    if (const IsosurfaceDesc* surface = std::get_if<IsosurfaceDesc>(&shape.geometry))
      list_density(*surface->density, loads);
  }
  for (const MaterialDesc& material : desc.materials)
    if (material.texture && !material.texture->file.empty())
      loads.emplace_back([file = material.texture->file](LoadedScene& loaded) { loaded.texture(file); });
  return loads;
}

}  // namespace

LoadAhead::LoadAhead(LoadedScene& loaded, const SceneDesc& desc) : exceptions_(std::uncaught_exceptions()) {
  std::vector<Load> loads = loads_of(desc);
  if (loads.empty()) return;
  thread_ = std::thread([this, &loaded, loads = std::move(loads)] {
    try {
      for (const Load& load : loads)
        if (!stopped_) load(loaded);
    } catch (...) {  // asked for again, in its turn, it says the same
    }
  });
}

LoadAhead::~LoadAhead() {
  stopped_ = std::uncaught_exceptions() > exceptions_;
  if (thread_.joinable()) thread_.join();
}

}  // namespace brume
