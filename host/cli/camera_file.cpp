// See camera_file.hpp.
#include "cli/camera_file.hpp"

#include "base/atomic_file.hpp"
#include "scene/scene_reader.hpp"
#include "scene/scene_writer.hpp"

namespace brume {

std::string camera_override(const std::filesystem::path& file) {
  return "/camera=" + camera_write(camera_read(scene_file_text(file), file));
}

void camera_save(const std::filesystem::path& file, const CameraDesc& camera) {
  atomic_write(file, camera_write(camera));
}

}  // namespace brume
