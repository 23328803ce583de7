// A viewpoint in a file of its own, for any scene.
#pragma once
#include <filesystem>
#include <string>

#include "scene/scene_desc.hpp"

namespace brume {

// The file holds a camera object, or a scene, of which its camera is meant. As an override of a scene:
// "/camera={...}". InputError, naming the file, for what is neither.
std::string camera_override(const std::filesystem::path& file);

void camera_save(const std::filesystem::path& file, const CameraDesc& camera);

}  // namespace brume
