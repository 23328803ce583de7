// The scene that a command was given: a file as it stands, or one made around a bare volume or mesh.
#pragma once
#include <functional>
#include <string>

#include "cli/render_arguments.hpp"
#include "load/loaded_scene.hpp"
#include "scene/scene_desc.hpp"

namespace brume {

// With the overrides of the arguments. `say` is told what was chosen for a bare file. Throws InputError.
SceneDesc scene_describe(const RenderArguments& arguments, LoadedScene& loaded,
                         const std::function<void(const std::string&)>& say);

}  // namespace brume
