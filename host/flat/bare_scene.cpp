// See bare_scene.hpp.
#include "flat/bare_scene.hpp"

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "base/error.hpp"
#include "base/file_read.hpp"
#include "flat/bounds.hpp"
#include "flat/transform.hpp"
#include "mesh/mesh.hpp"
#include "volume/density_source.hpp"

namespace brume {

namespace {

constexpr double VFOV = 35;         // degrees
constexpr double DENSEST_VIEW = 4;  // τ of the densest line of sight
constexpr double ALBEDO = 0.9;      // pale smoke
const dvec3 TOWARDS_CAMERA = glm::normalize(dvec3(0.35, 0.2, 1.0));

// Looks at the middle of the bounds from the front, a little right and above, so that their sphere just fits.
CameraDesc camera_frame(const Bounds& bounds) {
  CameraDesc camera;
  const double radius = 0.5 * glm::length(bounds.size());
  camera.vfov = VFOV;
  camera.target = bounds.center();
  camera.eye = camera.target + TOWARDS_CAMERA * (radius / std::sin(glm::radians(0.5 * VFOV)));
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

// Box of the non-zero samples, in world space.
Bounds grid_bounds(const Grid& grid, const GridStats& stats) {
  Bounds bounds;
  const dvec3 lo(stats.nonzero_min), hi(stats.nonzero_max + 1);
  for (int c = 0; c < 8; ++c)
    bounds.add(
        transform_point(grid.world_from_lattice, dvec3(c & 1 ? hi.x : lo.x, c & 2 ? hi.y : lo.y, c & 4 ? hi.z : lo.z)));
  return bounds;
}

// ∫ρ dt along one line through the grid, nearest samples every half voxel. A line as long as the bounds' diagonal, about `middle`.
double line_integral(const Grid& grid, const dmat4& lattice_from_world, const dvec3& middle, const dvec3& dir,
                     double length) {
  const dvec3 m = transform_point(lattice_from_world, middle), d = transform_dir(lattice_from_world, dir);
  const int steps = static_cast<int>(std::ceil(2 * length * glm::length(d)));
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const dvec3 p = m + d * (length * ((i + 0.5) / steps - 0.5));
    if (p.x < 0 || p.y < 0 || p.z < 0) continue;
    const ivec3 voxel(p);
    if (voxel.x < grid.size().x && voxel.y < grid.size().y && voxel.z < grid.size().z) sum += grid.at(voxel);
  }
  return sum * length / steps;
}

// The largest ∫ρ dt over lines of sight, on a lattice of parallel lines across the bounds.
double densest_line(const Grid& grid, const Bounds& bounds, const dvec3& forward, const dvec3& up) {
  constexpr int LINES = 48;
  const dmat4 lattice_from_world = glm::inverse(grid.world_from_lattice);
  const dvec3 right = glm::normalize(glm::cross(forward, up)), above = glm::cross(right, forward);
  const double size = glm::length(bounds.size());
  double densest = 0;
  for (int y = 0; y < LINES; ++y)
    for (int x = 0; x < LINES; ++x) {
      const dvec3 offset = size * (((x + 0.5) / LINES - 0.5) * right + ((y + 0.5) / LINES - 0.5) * above);
      densest = std::max(densest, line_integral(grid, lattice_from_world, bounds.center() + offset, forward, size));
    }
  return densest;
}

std::string box_text(const Bounds& b) {
  char text[160];
  std::snprintf(text, sizeof text, "[%.4g, %.4g, %.4g] to [%.4g, %.4g, %.4g]", b.lo.x, b.lo.y, b.lo.z, b.hi.x, b.hi.y,
                b.hi.z);
  return text;
}

SceneDesc scene_of_volume(const std::filesystem::path& file, std::string& report) {
  DensitySpec spec;
  spec.type = "file";
  spec.file = file;
  const Grid grid = density_make(spec);
  const GridStats stats = grid_stats(grid);
  if (stats.nonzero == 0)
    throw InputError(file.string() + ": grid '" + grid.name + "' is 0 everywhere; there is nothing to see");
  const Bounds bounds = grid_bounds(grid, stats);

  SceneDesc desc;
  desc.background = dvec3(0.06, 0.08, 0.11);
  desc.camera = camera_frame(bounds);
  desc.lights.push_back(key_light(desc.camera, 14));
  const double densest =
      densest_line(grid, bounds, glm::normalize(desc.camera.target - desc.camera.eye), desc.camera.up);
  const double sigma_t = DENSEST_VIEW / densest;
  MediumDesc medium;
  medium.density.type = "file";
  medium.density.file = file;
  medium.density.grid = grid.name;
  medium.sigma_s = dvec3(ALBEDO * sigma_t);
  medium.sigma_a = dvec3((1 - ALBEDO) * sigma_t);
  desc.media.push_back(medium);
  // About a per cent off the exact picture and ten times as fast; the scene that is saved says so.
  desc.render.method = METHOD_DDA_MIDPOINT;
  desc.render.shadow = SHADOW_GRID;
  desc.render.light_grid = 128;
  char text[400];
  std::snprintf(text, sizeof text,
                "%s, grid '%s': bounds %s; sigma_t %.4g per unit density, so that the densest view is about tau = %g",
                file.string().c_str(), grid.name.c_str(), box_text(bounds).c_str(), sigma_t, DENSEST_VIEW);
  report = text;
  return desc;
}

SceneDesc scene_of_mesh(const std::filesystem::path& file, std::string& report) {
  const Mesh mesh = mesh_read_obj(file);
  Bounds bounds;
  for (const dvec3& p : mesh.positions) bounds.add(p);

  SceneDesc desc;
  desc.background = dvec3(0.06, 0.08, 0.11);
  desc.ambient = dvec3(0.15);
  desc.camera = camera_frame(bounds);
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

struct BareRow {
  const char* extension;
  SceneDesc (*make)(const std::filesystem::path&, std::string&);
};
constexpr BareRow BARE_FILES[] = {{".vdb", scene_of_volume}, {".obj", scene_of_mesh}};

const BareRow* bare_row(const std::filesystem::path& file) {
  for (const BareRow& row : BARE_FILES)
    if (file_ending(file) == row.extension) return &row;
  return nullptr;
}

}  // namespace

bool bare_scene_takes(const std::filesystem::path& file) { return bare_row(file) != nullptr; }

SceneDesc bare_scene(const std::filesystem::path& file, std::string& report) {
  return bare_row(file)->make(file, report);
}

}  // namespace brume
