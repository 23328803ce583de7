// SceneDesc and what is loaded for it → FlatScene, laid out for the kernels.
#pragma once
#include "flat/flat_scene.hpp"
#include "load/loaded_scene.hpp"
#include "scene/scene_desc.hpp"

namespace brume {

// What `desc` names and `loaded` does not hold is loaded into it. bvh_width: that of the lanes that will traverse
// the BVH. Throws InputError naming the place in the scene (or the file behind it) for whatever cannot be rendered.
FlatScene scene_flatten(const SceneDesc& desc, LoadedScene& loaded, int bvh_width);

}  // namespace brume
