// Scenes made from the rows of the families, so that a new row is compared without being listed anywhere.
#pragma once
#include <string>
#include <vector>

#include "plan/render_plan.hpp"
#include "scene/scene_desc.hpp"

namespace brume {

// What a density can be for a method: each row of BRUME_INTERPOLATIONS, and constant.
struct DensityKind {
  std::string name;
  int fits;  // FITS_x
  int interpolation;
};
std::vector<DensityKind> density_kinds();

// A density of a type by its defaults: small, and cut from noise where the type cuts another.
DensityDesc density_of(const std::string& type);

// Colored fog over [-1,1]³ under a sun and a lamp, nothing else: its density of that kind, by that method.
SceneDesc fog_desc(const DensityKind& kind, int method);

// A scene of one shape: the one of that type in the scene "surfaces", else as its keys' defaults make it.
SceneDesc shape_desc(int type);

// Eight lights of that type, of all falloffs, in the scene "surfaces".
SceneDesc lights_desc(int type);

// A sphere of that material model.
SceneDesc material_desc(int model);

// Flattens at a size in pixels; errors name the scene as `name`.
PlannedScene row_scene(SceneDesc desc, const std::string& name, int size, int bvh_width);

}  // namespace brume
