// The parts of scene_flatten(), in the order in which it calls them. Loading comes first because the origin depends on
// all of it.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "flat/bounds.hpp"
#include "flat/bricks.hpp"
#include "flat/flat_scene.hpp"
#include "flat/media_methods.hpp"
#include "flat/transform.hpp"
#include "load/loaded_scene.hpp"
#include "mesh/mesh.hpp"
#include "scene/scene_desc.hpp"
#include "volume/grid.hpp"

namespace brume {

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

// The scene with an isosurface for every liquid of that model.
SceneDesc liquids_as_shapes(const SceneDesc& desc);

// An isosurface: its grid, placed as that of a medium.
struct LoadedIsosurface {
  LoadedMedium placed;
  double iso;
  std::string place;  // file and JSON pointer, for messages
};
LoadedIsosurface load_isosurface(const SceneDesc& desc, const ShapeDesc& shape, LoadedScene& loaded,
                                 std::vector<std::string>& notes);

// The masks of an isosurface for the stored bricks from `first` on; returns Isosurface::masks.
int iso_masks_append(std::size_t first, std::size_t bricks, float iso, FlatScene& scene);

// Where a mesh stands that is held once.
struct MeshPlace {
  dmat4 world_from_mesh;
  int material;   // an index into SceneDesc::materials; -1: those of the mesh
  Bounds bounds;  // in the world
};
// Triangles of a mesh, in the world; with places in their own space.
struct LoadedMesh {
  std::shared_ptr<const Mesh> mesh;
  std::size_t first, count;  // of its triangles
  int shading;               // a TriangleShading
  int material;              // as of a place, where it has none
  bool shows_own;            // some of its materials are those of the mesh
  std::vector<MeshPlace> places;
};
struct LoadedShapes {
  std::vector<const ShapeDesc*> analytic;
  std::vector<LoadedIsosurface> isosurfaces;  // of those among them, in their order
  std::vector<LoadedMesh> meshes;             // single triangles too; those with places stand last
  std::vector<int> first_material;            // per mesh: where its own materials begin in FlatScene::materials
  int default_material = 0;
  Bounds bounds;  // of everything finite
};
// Adds what is not told yet.
void note_once(std::vector<std::string>& notes, const std::string& note);

// Adds all meshes and triangles. Throws InputError for a singular instance.
void load_meshes(const SceneDesc& desc, LoadedScene& loaded, LoadedShapes& shapes, std::vector<std::string>& notes);
LoadedShapes load_shapes(const SceneDesc& desc, LoadedScene& loaded, std::vector<std::string>& notes);

void flatten_lights(const SceneDesc& desc, FlatScene& scene);
// Surfaces that emit become lights too; needs the materials, shapes and triangles.
void flatten_emitters(const SceneDesc& desc, FlatScene& scene);
void flatten_materials(const SceneDesc& desc, LoadedScene& loaded, LoadedShapes& shapes, FlatScene& scene);
void flatten_shapes(const LoadedShapes& shapes, FlatScene& scene);
// Triangles, instances and the BVHs of both.
void flatten_meshes(const LoadedShapes& shapes, FlatScene& scene);
// The BVH over shapes that have bounds and are no isosurfaces, where they are many; needs the shapes.
void flatten_shape_bvh(const LoadedShapes& shapes, FlatScene& scene);
// needed_again: LoadedScene's; where nobody needs them again, grids give their memory back on the way.
void flatten_media(const std::vector<LoadedMedium>& media, const std::vector<LoadedIsosurface>& isosurfaces,
                   bool needed_again, FlatScene& scene);

// Largest density of the medium, whose bricks are the last of the scene: those of the voxels from first_voxel on.
float density_max(const Medium& medium, std::size_t first_voxel, const FlatScene& scene);
// Puts its densities, the voxels from first_voxel on, into units that float and half hold; returns the unit, a power of
// two.
double densities_scale(Medium& medium, std::size_t first_voxel, FlatScene& scene);
// Coefficients times `per`: flat units of length, units of density.
void coefficients_flatten(const MediumDesc& desc, double per, MediumBody& medium);

}  // namespace brume
