// SceneDesc and what is loaded for it → FlatScene, laid out for the kernels; and with the plan of one picture in one
// call.
#pragma once
#include "flat/bounds.hpp"
#include "flat/render_plan.hpp"
#include "load/loaded_scene.hpp"
#include "scene/scene_desc.hpp"
#include "volume/grid.hpp"

namespace brume {

// What `desc` names and `loaded` does not hold is loaded into it. bvh_width: a multiple of the lanes that will traverse
// the BVH. Throws InputError naming the place in the scene (or the file behind it) for whatever cannot be rendered.
FlatScene scene_flatten(const SceneDesc& desc, LoadedScene& loaded, int bvh_width);

struct FlattenOptions {
  int bvh_width = 4;
  std::array<int, 4> crop{0, 0, 0, 0};  // as in PlanOptions
  bool hide_background = false;
  bool keep_voxels = false;  // as given, whatever the storage: devices pack them for themselves
};

// A scene for one picture, with its plan.
PlannedScene flatten(const SceneDesc& desc, LoadedScene& loaded, const FlattenOptions& options);
PlannedScene flatten(const SceneDesc& desc, const FlattenOptions& options);  // whose files nobody needs again

}  // namespace brume
