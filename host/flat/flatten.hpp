// SceneDesc and what is loaded for it → FlatScene: resolves the method, lays everything out for the kernels.
#pragma once
#include "flat/bounds.hpp"
#include "flat/flat_scene.hpp"
#include "load/loaded_scene.hpp"
#include "scene/scene_desc.hpp"
#include "volume/grid.hpp"

namespace brume {

struct FlattenOptions {
  int bvh_width = 4;                    // a multiple of the lanes that will traverse it
  std::array<int, 4> crop{0, 0, 0, 0};  // x0, y0, x1, y1 in pixels; empty: the whole film
  bool hide_background = false;         // from the camera; mirrors and glass go on seeing it
};

// Throws InputError naming the place in the scene (or the file behind it) for whatever cannot be rendered. What `desc` names and
// `loaded` does not hold is loaded into it.
FlatScene flatten(const SceneDesc& desc, LoadedScene& loaded, const FlattenOptions& options);
// The same for one picture, whose files nobody needs again.
FlatScene flatten(const SceneDesc& desc, const FlattenOptions& options);

}  // namespace brume
