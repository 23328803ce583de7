// The parts of flatten(), in the order in which it calls them. Loading comes first because the origin depends on all of it.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "flat/bounds.hpp"
#include "flat/bricks.hpp"
#include "flat/flat_scene.hpp"
#include "flat/transform.hpp"
#include "mesh/mesh.hpp"
#include "scene/scene_desc.hpp"
#include "volume/grid.hpp"

namespace brume {

// A medium with its grid in memory. Constant media have a grid only where a voxel method asks for one.
struct LoadedMedium {
  std::shared_ptr<const MediumDesc> desc;
  int method;                // resolved, never auto
  bool is_constant, sphere;  // closed form; cut to a sphere
  double constant = 0;
  std::optional<Grid> grid;
  dmat4 world_from_lattice{1.0};  // lattice: [0, size] of the grid, or the unit cube of a constant medium
};
std::vector<LoadedMedium> load_media(const SceneDesc& desc, std::vector<std::string>& notes);
void medium_bounds_add(const LoadedMedium& medium, Bounds& bounds);

struct LoadedMesh {
  const ShapeDesc* shape;
  Mesh mesh;
};
struct LoadedShapes {
  std::vector<const ShapeDesc*> analytic;
  std::vector<LoadedMesh> meshes;   // single triangles too
  std::vector<int> first_material;  // per mesh: where its own materials begin in FlatScene::materials
  int default_material = 0;
  Bounds bounds;  // of everything finite
};
// Adds what is not told yet.
void note_once(std::vector<std::string>& notes, const std::string& note);

LoadedShapes load_shapes(const SceneDesc& desc, std::vector<std::string>& notes);

void flatten_camera(const SceneDesc& desc, const Bounds& bounds, FlatScene& scene);  // bounds: of everything finite
void flatten_lights(const SceneDesc& desc, FlatScene& scene);
void flatten_materials(const SceneDesc& desc, LoadedShapes& shapes, FlatScene& scene);
void flatten_shapes(const LoadedShapes& shapes, FlatScene& scene);
void flatten_media(const SceneDesc& desc, std::vector<LoadedMedium>& media, FlatScene& scene);  // takes their grids

// Throws InputError where the steps of marched media ask for more lookups than can be meant.
void work_check(const SceneDesc& desc, const FlatScene& scene);

// Largest density of the medium, whose bricks are the last of the scene: those of the voxels from first_voxel on.
float density_max(const Medium& medium, std::size_t first_voxel, const FlatScene& scene);
// Puts its densities, the voxels from first_voxel on, into units that float and half hold; returns the unit, a power of two.
double densities_scale(Medium& medium, std::size_t first_voxel, FlatScene& scene);
// Coefficients times `per`: flat units of length, units of density.
void coefficients_flatten(const MediumDesc& desc, double per, Medium& medium);

// The light grids of a medium to which they pay, one per light (shared/light_grid.h). Needs the medium's geometry and the lights.
// Throws InputError where they have more entries than kernels count.
void light_grids_append(const SceneDesc& desc, Medium& medium, FlatScene& scene);

}  // namespace brume
