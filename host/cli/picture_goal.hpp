// The settings of a picture that is to reach an error or a time.
#pragma once
#include <functional>
#include <string>

#include "cl/context.hpp"
#include "cli/picture_error.hpp"
#include "cli/render_arguments.hpp"
#include "load/loaded_scene.hpp"
#include "plan/planned_scene.hpp"
#include "render/renderer.hpp"
#include "scene/scene_desc.hpp"
#include "witness/witnesses.hpp"

namespace brume {

// `desc` with the method, step and light grid that its goal leads to, and what to say of them; those that are out of
// reach are a note. `desc` itself where it has no goal or no medium. Throws Interrupted.
SceneDesc picture_for_goal(const RenderArguments& arguments, const SceneDesc& desc, LoadedScene& loaded,
                           Context& context, int lanes, std::vector<std::string>& notes,
                           const std::function<void(const std::string&)>& say);

// A finished picture whose witnesses say that it is further off than its scene asks for: refined by finer settings, as
// long as that helps and at most three times, and asked again. Of every time `say` tells. Throws Interrupted, the film
// complete as it was before or refined.
void picture_refine_for_goal(const RenderArguments& arguments, const SceneDesc& desc, const PlannedScene& flat,
                             Context& context, const Renderer& renderer, Film& film, PictureError& error,
                             const std::function<void(const std::string&)>& say);

// A note where the error that a finished picture was told is above what its scene asks for; else empty.
std::string goal_missed_note(const RenderDesc& goal, const WitnessError& error);

}  // namespace brume
