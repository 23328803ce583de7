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

}  // namespace

SceneDesc scene_describe(const RenderArguments& arguments, LoadedScene& loaded,
                         const std::function<void(const std::string&)>& say) {
  if (file_kind(arguments.scene) == FileKind::SCENE) return scene_read(arguments.scene, arguments.all_overrides());
  std::string report;
  const SceneDesc bare = bare_scene(arguments.scene, loaded, report, film_size(arguments));
  say(report);
  const std::filesystem::path folder = arguments.scene.parent_path();
  SceneDesc desc = scene_read_text(scene_write(bare, folder), folder / (arguments.scene.filename().string() + ".json"),
                                   arguments.all_overrides());
  desc.file = arguments.scene;
  return desc;
}

}  // namespace brume
