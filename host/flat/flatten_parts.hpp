// The parts of flatten(), in the order in which it calls them. Loading comes first because the origin depends on all of
// it.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "flat/bounds.hpp"
#include "flat/bricks.hpp"
#include "flat/render_plan.hpp"
#include "flat/transform.hpp"
#include "load/loaded_scene.hpp"
#include "mesh/mesh.hpp"
#include "scene/scene_desc.hpp"
#include "volume/grid.hpp"

namespace brume {

// A medium of the flat scene: those of the scene file, and the glows among them that have a density of their own.
struct MediumRow {
  std::shared_ptr<const MediumDesc> desc;
  bool only_glows;
};
std::vector<MediumRow> media_rows(const SceneDesc& desc);

// The method of a medium: a method of its own has to fit it; where that of the picture does not, it is the exact one.
// Never auto. Throws InputError.
int method_resolve(const SceneDesc& desc, const MediumDesc& medium);
// Throws InputError where methods or light grids fit no medium; notes media that take another method than the picture
// asks for.
void media_check(const SceneDesc& desc, const std::vector<MediumRow>& media, std::vector<std::string>& notes);

// A medium with its grid in memory. Constant media have a grid only where a voxel method asks for one.
struct LoadedMedium {
  std::shared_ptr<const MediumDesc> desc;
  bool is_constant, sphere;  // closed form; cut to a sphere
  bool only_glows;           // it is the glow of another medium
  double constant = 0;
  std::shared_ptr<Grid> grid;     // media of the same density share it
  dmat4 world_from_lattice{1.0};  // lattice: [0, size] of the grid, or the unit cube of a constant medium
};
std::vector<LoadedMedium> load_media(const SceneDesc& desc, LoadedScene& loaded, std::vector<std::string>& notes);
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

LoadedShapes load_shapes(const SceneDesc& desc, LoadedScene& loaded, std::vector<std::string>& notes);

inline constexpr double FAR_AWAY = 16;  // flat units from the scene's centre, from which on eyes and lights are far
void flatten_lights(const SceneDesc& desc, FlatScene& scene);
// How many lights a point asks: render.light_samples, see shared/light.h. Throws InputError where they are too many.
int plan_light_picks(const SceneDesc& desc, const FlatScene& scene);
void flatten_materials(const SceneDesc& desc, LoadedScene& loaded, LoadedShapes& shapes, FlatScene& scene);
void flatten_shapes(const LoadedShapes& shapes, FlatScene& scene);
// needed_again: LoadedScene's; where nobody needs them again, grids give their memory back on the way.
void flatten_media(const std::vector<LoadedMedium>& media, bool needed_again, FlatScene& scene);

// Camera, film and what "render" says of rays.
void plan_camera(const SceneDesc& desc, const FlatScene& scene, Frame& frame);

// Throws InputError where the steps of marched media ask for more lookups than can be meant.
void work_check(const SceneDesc& desc, const FlatScene& scene, const RenderPlan& plan);

// Largest density of the medium, whose bricks are the last of the scene: those of the voxels from first_voxel on.
float density_max(const Medium& medium, std::size_t first_voxel, const FlatScene& scene);
// Puts its densities, the voxels from first_voxel on, into units that float and half hold; returns the unit, a power of
// two.
double densities_scale(Medium& medium, std::size_t first_voxel, FlatScene& scene);
// Coefficients times `per`: flat units of length, units of density.
void coefficients_flatten(const MediumDesc& desc, double per, MediumBody& medium);

// The light grids of a medium to which they pay, one per light (shared/light_grid.h): the number of the first, -1 for
// none. Needs the medium's geometry and coefficients, and the lights.
// Throws InputError where they have more entries than kernels count.
int light_grids_append(const SceneDesc& desc, const Medium& medium, const FlatScene& scene, RenderPlan& plan);

}  // namespace brume
