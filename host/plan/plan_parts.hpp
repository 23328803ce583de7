// The parts of plan_render().
#pragma once
#include "flat/flat_scene.hpp"
#include "plan/piece_errors.hpp"
#include "plan/render_plan.hpp"
#include "scene/scene_desc.hpp"

namespace brume {

// Steps through a constant medium near a light, as shares of the distance to it (PICTURE, Lit steps).
inline constexpr float LIGHT_GRADE = 0.1f;

// Camera, film and what "render" says of rays.
void plan_camera(const SceneDesc& desc, const FlatScene& scene, Frame& frame);

// Which lights a point asks, how many of them, and by which share each is chosen (shared/light.h). Throws InputError
// where they are too many.
void plan_lights(const SceneDesc& desc, const FlatScene& scene, RenderPlan& plan);

// Of each medium the number of its first light grid, of which there is one per light (shared/light_grid.h); -1 where
// they do not pay. Media on one spot share the entries. Needs the media's geometry and coefficients, and the lights.
// Throws InputError where they have more entries than kernels count.
std::vector<int> light_grids_plan(const SceneDesc& desc, const std::vector<Medium>& media, RenderPlan& plan);

// What `adaptive` needs to know of a medium, for this tolerance; adds to RenderPlan::piece_rates, and to the errors
// where they are not known yet.
void adaptive_plan(double tolerance, const FlatScene& scene, std::size_t medium, PieceErrors& known, RenderPlan& plan);

// Throws InputError where the steps of marched media ask for more lookups than can be meant.
void work_check(const SceneDesc& desc, const FlatScene& scene, const RenderPlan& plan);

}  // namespace brume
