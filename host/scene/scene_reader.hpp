// Scene file → SceneDesc. Keys, defaults and ranges: scenes/README.md. Loads nothing but the file itself.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/frame_pattern.hpp"
#include "scene/scene_desc.hpp"

namespace brume {

// `overrides`: "/json/pointer=VALUE", applied before anything is read. VALUE is JSON, or else a plain string; an index
// "-" appends. Of a sequence, `frame` says which of its frames is meant. Throws InputError "file: /place: cause, what is
// allowed".
SceneDesc scene_read(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                     int frame = FRAME_NONE);

// The same for a text; `as_file` names it in messages, and paths in it are relative to as_file's folder.
SceneDesc scene_read_text(std::string_view text, const std::filesystem::path& as_file,
                          const std::vector<std::string>& overrides, int frame = FRAME_NONE);

// Of a text that is a camera object, or a scene that has one; only the camera of that is looked at.
CameraDesc camera_read(std::string_view text, const std::filesystem::path& as_file);

// The text of a scene file, or of a camera's.
std::string scene_file_text(const std::filesystem::path& file);

}  // namespace brume
