// SceneDesc → the text of a scene file that reads back to the same scene.
#pragma once
#include <filesystem>
#include <string>

#include "scene/scene_desc.hpp"

namespace brume {

// Paths are written relative to `folder`, where the text is going to stand.
std::string scene_write(const SceneDesc& desc, const std::filesystem::path& folder);

// A camera object alone.
std::string camera_write(const CameraDesc& camera);

}  // namespace brume
