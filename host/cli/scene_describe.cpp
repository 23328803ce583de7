// See scene_describe.hpp.
#include "cli/scene_describe.hpp"

#include "cli/file_kind.hpp"
#include "flat/bare_scene.hpp"
#include "scene/scene_reader.hpp"
#include "scene/scene_writer.hpp"

namespace brume {

namespace {

// That of the overrides: the camera of a bare file depends on its shape.
ivec2 film_size(const RenderArguments& arguments) {
  std::vector<std::string> film;
  for (const std::string& override : arguments.all_overrides())
    if (override.rfind("/film", 0) == 0) film.push_back(override);
  return scene_read_text("{}", arguments.scene, film).film.size;
}

// A bare file is the only one that its scene names.
void rename(SceneDesc& bare, const std::filesystem::path& named) {
  for (MediumDesc& medium : bare.media) medium.density.file = named;
  for (ShapeDesc& shape : bare.shapes)
    if (MeshDesc* mesh = std::get_if<MeshDesc>(&shape.geometry)) mesh->file = named;
}

}  // namespace

SceneText scene_text(const RenderArguments& arguments, const std::filesystem::path& named, LoadedScene& loaded,
                     const Say& say) {
  if (file_kind(arguments.scene) == FileKind::SCENE) return {named, named, scene_file_text(arguments.scene)};
  std::string report;
  SceneDesc bare = bare_scene(arguments.scene, loaded, report, film_size(arguments));
  say(report);
  rename(bare, named);
  const std::filesystem::path folder = arguments.scene.parent_path();
  return {named, folder / (named.filename().string() + ".json"), scene_write(bare, folder)};
}

SceneDesc scene_of_text(const SceneText& text, const std::vector<std::string>& overrides, int frame) {
  SceneDesc desc = scene_read_text(text.text, text.as_file, overrides, frame);
  desc.file = frame >= 0 ? std::filesystem::path(frame_name(text.file.string(), frame)) : text.file;
  return desc;
}

SceneDesc scene_describe(const RenderArguments& arguments, LoadedScene& loaded, const Say& say) {
  return scene_of_text(scene_text(arguments, arguments.scene, loaded, say), arguments.all_overrides(), FRAME_NONE);
}

}  // namespace brume
