// See planned_scene.hpp.
#include "plan/planned_scene.hpp"

#include "flat/flatten.hpp"

namespace brume {

PlannedScene flatten(const SceneDesc& desc, LoadedScene& loaded, const FlattenOptions& options) {
  PlannedScene scene;
  static_cast<FlatScene&>(scene) = scene_flatten(desc, loaded, options.bvh_width);
  static_cast<RenderPlan&>(scene) = plan_render(desc, scene, {options.crop, options.hide_background});
  if (options.keep_voxels || scene.storage == STORAGE_F32 || scene.voxels.empty()) return scene;
  const auto stored = std::make_shared<StoredVoxels>(voxels_store(scene, scene.storage, scene.voxels));
  scene.brick_ranges = stored->ranges;
  scene.stored = stored;
  return scene;
}

PlannedScene flatten(const SceneDesc& desc, const FlattenOptions& options) {
  LoadedScene loaded;
  loaded.needed_again = false;
  return flatten(desc, loaded, options);
}

}  // namespace brume
