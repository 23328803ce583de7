// The scene that a command was given: a file as it stands, or one made around a bare volume or mesh.
#pragma once
#include <filesystem>
#include <functional>
#include <string>

#include "base/frame_pattern.hpp"
#include "cli/render_arguments.hpp"
#include "load/loaded_scene.hpp"
#include "scene/scene_desc.hpp"

namespace brume {

using Say = std::function<void(const std::string&)>;

// With the overrides of the arguments. `say` is told what was chosen for a bare file. Throws InputError.
SceneDesc scene_describe(const RenderArguments& arguments, LoadedScene& loaded, const Say& say);

// The text of a scene, from which the descriptions of its frames come.
struct SceneText {
  std::filesystem::path file;     // as the user named it
  std::filesystem::path as_file;  // to which paths in the text are relative
  std::string text;
};

// That of a scene file, or of one made around a bare file: all frames of a sequence have the camera and coefficients
// of one. `named`: what the scene says in place of that one's name, "tank_%04d.vdb".
SceneText scene_text(const RenderArguments& arguments, const std::filesystem::path& named, LoadedScene& loaded,
                     const Say& say);
SceneDesc scene_of_text(const SceneText& text, const std::vector<std::string>& overrides, int frame);

}  // namespace brume
