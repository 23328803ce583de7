// A scene flattened for one picture, with the plan of it, in one call.
#pragma once
#include <array>

#include "load/loaded_scene.hpp"
#include "plan/render_plan.hpp"
#include "scene/scene_desc.hpp"

namespace brume {

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
