// See bare_scene.hpp.
#include "flat/bare_scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "base/error.hpp"
#include "base/file_read.hpp"
#include "base/number_text.hpp"
#include "flat/bounds.hpp"
#include "flat/densest_view.hpp"
#include "flat/mesh_outline.hpp"
#include "flat/transform.hpp"
#include "mesh/mesh.hpp"
#include "volume/volume_file.hpp"

namespace brume {

namespace {

constexpr double VFOV = 35;                              // degrees
constexpr double DENSEST_VIEW = 4;                       // τ of the densest line of sight
constexpr double ALBEDO = 0.9;                           // pale smoke
constexpr float VALUE_MIN = 1e-20f, VALUE_MAX = 1e20f;   // of the largest density, and lengths,
constexpr double EXTENT_MIN = 1e-30, EXTENT_MAX = 1e30;  // whose coefficients and cameras single precision holds
const dvec3 TOWARDS_CAMERA = glm::normalize(dvec3(0.35, 0.2, 1.0));

// Looks at the middle of the bounds from the front, a little right and above, so that their sphere just fits, into a
// portrait too.
CameraDesc camera_frame(const Bounds& bounds, ivec2 film) {
  CameraDesc camera;
  const double radius = 0.5 * glm::length(bounds.size()), up = glm::radians(0.5 * VFOV);
  const double sideways = std::atan(std::tan(up) * film.x / film.y);
  camera.vfov = VFOV;
  camera.target = bounds.center();
  camera.eye = camera.target + TOWARDS_CAMERA * (radius / std::sin(std::min(up, sideways)));
  return camera;
}

// Travels to the right, down and away from the viewer: the light stands at the upper left, in front.
LightDesc key_light(const CameraDesc& camera, double irradiance) {
  const dvec3 forward = glm::normalize(camera.target - camera.eye);
  const dvec3 right = glm::normalize(glm::cross(forward, camera.up));
  LightDesc light;
  light.type = LIGHT_DIRECTIONAL;
  light.direction = 0.7 * right - 0.8 * glm::cross(right, forward) + 0.35 * forward;
  light.intensity = dvec3(irradiance);
  return light;
}

// Box of the non-zero samples and of the voxel over which they fade, in world space.
Bounds grid_bounds(const Grid& grid, const GridStats& stats) {
  Bounds bounds;
  const bool empty = stats.nonzero == 0;
  const dvec3 lo = empty ? dvec3(0) : dvec3(stats.nonzero_min) - 0.5;
  const dvec3 hi = empty ? dvec3(grid.size()) : dvec3(stats.nonzero_max) + 1.5;
  for (int c = 0; c < 8; ++c)
    bounds.add(
        transform_point(grid.world_from_lattice, dvec3(c & 1 ? hi.x : lo.x, c & 2 ? hi.y : lo.y, c & 4 ? hi.z : lo.z)));
  return bounds;
}

// With as many digits as tell its ends apart, wherever it stands: 4 of its longest side.
std::string box_text(const Bounds& b) {
  const dvec3 far = glm::max(glm::abs(b.lo), glm::abs(b.hi)), size = b.size();
  const double ratio = std::max({far.x, far.y, far.z}) / std::max({size.x, size.y, size.z});
  const int digits = std::isfinite(ratio) ? 4 + std::clamp(static_cast<int>(std::floor(std::log10(ratio))), 0, 12) : 4;
  char text[200];
  std::snprintf(text, sizeof text, "[%.*g, %.*g, %.*g] to [%.*g, %.*g, %.*g]", digits, b.lo.x, digits, b.lo.y, digits,
                b.lo.z, digits, b.hi.x, digits, b.hi.y, digits, b.hi.z);
  return text;
}

// Coefficients that make the densest view τ = DENSEST_VIEW, and a line that says so. Values whose coefficients single
// precision could not hold are brought to 1 first.
std::string medium_expose(MediumDesc& medium, const Grid& grid, float largest, const CameraDesc& camera) {
  double densest = grid_densest_view(grid, camera.eye, camera.target);
  if (!(densest > 0)) {
    medium.sigma_s = dvec3(1);
    return "it is 0 everywhere: there is nothing to see";
  }
  std::string scaled;
  if (largest < VALUE_MIN || largest > VALUE_MAX) {
    medium.density.remap = {{0, 0}, {largest, 1}};
    densest /= largest;
    scaled = "values up to " + number_text(largest, 4) + " are mapped to 1; ";
  }
  const double sigma_t = DENSEST_VIEW / densest;
  medium.sigma_s = dvec3(ALBEDO * sigma_t);
  medium.sigma_a = dvec3((1 - ALBEDO) * sigma_t);
  return scaled + "sigma_t " + number_text(sigma_t, 4) +
         " per unit density, so that the densest view is tau = " + number_text(DENSEST_VIEW, 4);
}

SceneDesc scene_of_volume(const std::filesystem::path& file, ivec2 film, LoadedScene& loaded, std::string& report) {
  VolumeFirst volume = volume_read_first(file);
  const GridStats stats = grid_stats(volume.grid);
  const Bounds bounds = grid_bounds(volume.grid, stats);
  const double extent = glm::length(bounds.size());
  if (!(extent >= EXTENT_MIN && extent <= EXTENT_MAX))
    throw InputError(file.string() + ": is " + number_text(extent, 4) + " across; a volume alone may be " +
                     number_text(EXTENT_MIN) + " to " + number_text(EXTENT_MAX) + ", in a scene \"bounds\" places it");

  SceneDesc desc;
  desc.background = dvec3(0.06, 0.08, 0.11);
  desc.camera = camera_frame(bounds, film);
  desc.lights.push_back(key_light(desc.camera, 14));
  MediumDesc medium;
  medium.density.type = "file";
  medium.density.file = file;
  medium.density.grid = volume.grid.name;
  medium.density.level_set = volume.fill ? LEVEL_SET_FILL : LEVEL_SET_REFUSE;
  const std::string exposure = medium_expose(medium, volume.grid, stats.max, desc.camera);
  desc.media.push_back(medium);
  // About a per cent off the exact picture and ten times as fast; the scene that is saved says so.
  desc.render.method = METHOD_DDA_MIDPOINT;
  desc.render.shadow = SHADOW_GRID;
  desc.render.light_grid = 128;
  report = file.string() + ", grid '" + volume.grid.name + "'" + volume.why + (volume.fill ? ", filled" : "") +
           ": bounds " + box_text(bounds) + "; " + exposure;
  if (medium.density.remap.empty()) loaded.keep(medium.density, std::move(volume.grid));
  return desc;
}

SceneDesc scene_of_mesh(const std::filesystem::path& file, ivec2 film, LoadedScene& loaded, std::string& report) {
  const std::shared_ptr<const Mesh> read = loaded.mesh(file);
  const Mesh& mesh = *read;
  const Bounds bounds = mesh_bounds(mesh);

  SceneDesc desc;
  desc.background = dvec3(0.06, 0.08, 0.11);
  desc.ambient = dvec3(0.15);
  desc.camera = camera_frame(bounds, film);
  const auto emits = [](const MeshMaterial& m) { return m.emission != dvec3(0); };
  if (std::none_of(mesh.materials.begin(), mesh.materials.end(), emits))  // else it has its own lights
    desc.lights.push_back(key_light(desc.camera, 3));
  MeshDesc shape;
  shape.file = file;
  desc.shapes.push_back({shape, -1, "/shapes/0"});
  if (mesh.materials.empty()) {
    MaterialDesc grey;
    grey.name = "grey";
    grey.diffuse = grey.ambient = dvec3(0.7);
    desc.materials.push_back(grey);
    desc.shapes.back().material = 0;
  }
  report = file.string() + ": " + std::to_string(mesh.triangles.size()) + " triangles, bounds " + box_text(bounds);
  return desc;
}

}  // namespace

SceneDesc bare_scene(const std::filesystem::path& file, LoadedScene& loaded, std::string& report, ivec2 film) {
  const std::vector<std::string>& meshes = mesh_endings();
  const bool is_mesh = std::find(meshes.begin(), meshes.end(), file_ending(file)) != meshes.end();
  return (is_mesh ? scene_of_mesh : scene_of_volume)(file, film, loaded, report);
}

}  // namespace brume
