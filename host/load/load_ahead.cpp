// See load_ahead.hpp.
#include "load/load_ahead.hpp"

#include <exception>
#include <functional>
#include <vector>

#include "load/scene_files.hpp"

namespace brume {

namespace {

using Load = std::function<void(LoadedScene&)>;

std::vector<Load> loads_of(const SceneDesc& desc) {
  const SceneFiles files = scene_files(desc);
  std::vector<Load> loads;
  for (const DensityDesc& density : files.densities)
    loads.emplace_back([density](LoadedScene& loaded) { loaded.grid(density); });
  for (const auto& file : files.meshes) loads.emplace_back([file](LoadedScene& loaded) { loaded.mesh(file); });
  for (const auto& file : files.placements)
    loads.emplace_back([file](LoadedScene& loaded) { loaded.placements(file); });
  for (const auto& file : files.textures) loads.emplace_back([file](LoadedScene& loaded) { loaded.texture(file); });
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
