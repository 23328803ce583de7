// A scene for a volume or a mesh that comes alone: camera that frames it, a key light from the upper left, coefficients
// that make the densest view τ = 4.
#pragma once
#include <filesystem>

#include "load/loaded_scene.hpp"
#include "scene/scene_desc.hpp"

namespace brume {

// Of a mesh, or of a volume; InputError for what is neither. `report` receives one line saying what was chosen
// (σt, the densest view, ...). The camera frames it in a film of that shape. What it reads is in `loaded`, under the
// names of the description.
SceneDesc bare_scene(const std::filesystem::path& file, LoadedScene& loaded, std::string& report, ivec2 film = {1, 1});

}  // namespace brume
