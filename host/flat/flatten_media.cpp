// Media: where the grid of each lies, its coefficients.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <tuple>

#include "base/error.hpp"
#include "base/number_text.hpp"
#include "flat/flatten_parts.hpp"
#include "scene/families.hpp"

namespace brume {

namespace {

double constant_value(const DensityDesc& d) { return d.of ? d.of->value : d.value; }

dmat4 lattice_onto_bounds(const std::array<dvec3, 2>& bounds, const dvec3& size) {
  dmat4 m(1.0);
  for (int axis = 0; axis < 3; ++axis) {
    m[axis][axis] = (bounds[1][axis] - bounds[0][axis]) / size[axis];
    m[3][axis] = bounds[0][axis];
  }
  return m;
}

const std::array<dvec3, 2> UNIT_BOUNDS{dvec3(-1), dvec3(1)};  // of what says none

LoadedMedium load_grid(const std::shared_ptr<const MediumDesc>& desc, bool only_glows, int level,
                       LoadedScene& loaded_scene, std::vector<std::string>& notes) {
  const MediumDesc& m = *desc;
  LoadedMedium loaded{desc, false, false, only_glows, 0, loaded_scene.grid(m.density, level), dmat4(1.0)};
  for (const std::string& note : loaded.grid->notes) note_once(notes, note);
  const dvec3 size(loaded.grid->full_size);
  const bool own = m.density.type == "file" && !m.bounds;
  loaded.world_from_lattice =
      transform_matrix(m.transform) *
      (own ? loaded.grid->world_from_lattice : lattice_onto_bounds(m.bounds.value_or(UNIT_BOUNDS), size));
  for (int axis = 0; axis < 3; ++axis) loaded.world_from_lattice[axis] *= loaded.grid->spacing[axis];
  return loaded;
}

LoadedMedium load_medium(const SceneDesc& desc, const MediumRow& row, LoadedScene& loaded_scene,
                         std::vector<std::string>& notes) {
  const MediumDesc& m = *row.desc;
  if (takes_constant(desc, m)) {
    LoadedMedium loaded{row.desc, false, false, row.only_glows, 0, nullptr, dmat4(1.0)};
    loaded.is_constant = true;
    loaded.sphere = m.density.type == "sphere";
    loaded.constant = constant_value(m.density);
    loaded.world_from_lattice =
        transform_matrix(m.transform) * lattice_onto_bounds(m.bounds.value_or(UNIT_BOUNDS), dvec3(1));
    return loaded;
  }
  return load_grid(row.desc, row.only_glows, desc.render.level, loaded_scene, notes);
}

// How far the medium goes on beyond its lattice [0, size], in voxels: a trilinear field with zero outside fades over
// half a voxel more.
double medium_fade(const LoadedMedium& m) {
  return m.grid && m.grid->border == Border::ZERO && m.desc->interpolation == INTERPOLATION_TRILINEAR ? 0.5 : 0.0;
}

dvec3 medium_size(const LoadedMedium& m) { return m.grid ? dvec3(m.grid->size()) : dvec3(1); }

double medium_longest(const LoadedMedium& m) {
  const dvec3 size = medium_size(m) + 2 * medium_fade(m);
  double longest = 0;
  for (int axis = 0; axis < 3; ++axis)
    longest = std::max(longest, glm::length(dvec3(m.world_from_lattice[axis])) * size[axis]);
  return longest;
}

// A density in the flat scene, before it stands anywhere: a grid, or one value.
struct FlatDensity {
  Medium medium;                            // its geometry in cell space
  int grid = -1;                            // of FlatScene::grids
  double unit = 1;                          // of the densities stored
  float largest = 0;                        // in that unit
  std::size_t first_brick = 0, bricks = 0;  // of the stored ones
  int gradients = 0;                        // of a liquid: Liquid::gradients
};

// Grids already in bricks, by grid, interpolation (the padding depends on that) and type of the medium (a liquid has
// gradients).
using FlatGrids = std::map<std::tuple<const Grid*, int, int>, FlatDensity>;

FlatDensity density_flatten(const LoadedMedium& loaded, bool needed_again, FlatScene& scene) {
  const bool liquid = loaded.desc->type == MEDIUM_LIQUID;
  FlatDensity density{};
  Medium& medium = density.medium;
  medium.interpolation = loaded.desc->interpolation;
  medium.region = loaded.sphere ? REGION_SPHERE : REGION_BOX;
  medium.is_constant = loaded.is_constant;
  medium.constant_density = static_cast<float>(loaded.constant);
  medium.hi = {1, 1, 1};
  medium.liquid = liquid ? 0 : -1;
  const std::size_t first_voxel = scene.voxels.size();
  density.grid = -1;
  if (!loaded.is_constant) {
    // held by the loaded scene and by this medium alone
    if (!needed_again && loaded.grid.use_count() == 2)
      bricks_append(std::move(*loaded.grid), medium, scene);
    else
      bricks_append(*loaded.grid, medium, scene);
    density.grid = static_cast<int>(scene.grids.size());
    scene.grids.push_back(brick_grid_of(medium));
  }
  if (liquid)
    density.gradients = gradient_bricks_append(medium, first_voxel, scene);
  else
    density.unit = densities_scale(medium, first_voxel, scene);
  density.largest = density_max(medium, first_voxel, scene);
  density.first_brick = first_voxel / BRICK_VALUES;
  density.bricks = scene.voxels.size() / BRICK_VALUES - density.first_brick;
  return density;
}

// Where the cells of a trilinear grid stand in the flat scene.
dmat4 cells_from_flat(const LoadedMedium& loaded, const FlatScene& scene) {
  dmat4 cell_from_world = glm::inverse(flat_from(scene, loaded.world_from_lattice));
  cell_from_world[3] += glm::dvec4(0.5, 0.5, 0.5, 0.0);  // see bricks_append
  return cell_from_world;
}

// Where a density stands; media that stand on one spot share the row.
int density_place(const FlatDensity& density, const LoadedMedium& loaded, FlatScene& scene) {
  const bool trilinear = !loaded.is_constant && loaded.desc->interpolation == INTERPOLATION_TRILINEAR;
  const dmat4 cell_from_world =
      trilinear ? cells_from_flat(loaded, scene) : glm::inverse(flat_from(scene, loaded.world_from_lattice));
  const Medium& m = density.medium;
  const PlacedGrid placed{affine(cell_from_world),
                          affine(glm::inverse(cell_from_world)),
                          m.lo,
                          density.grid,
                          m.hi,
                          m.interpolation,
                          m.region,
                          m.constant_density};
  using Words = std::array<std::uint32_t, sizeof(PlacedGrid) / sizeof(std::uint32_t)>;
  const auto words = [](const PlacedGrid& grid) {
    Words bits;
    std::memcpy(bits.data(), &grid, sizeof bits);
    return bits;
  };
  const auto same = [&, own = words(placed)](const PlacedGrid& other) { return words(other) == own; };
  const auto known = std::find_if(scene.placed.begin(), scene.placed.end(), same);
  if (known != scene.placed.end()) return static_cast<int>(known - scene.placed.begin());
  scene.placed.push_back(placed);
  return static_cast<int>(scene.placed.size()) - 1;
}

// Of presences: flat units per voxel, a ramp over one voxel being the sharpest that is resolved.
double voxel_size(const LoadedMedium& loaded, const FlatScene& scene) {
  return std::cbrt(std::abs(glm::determinant(glm::dmat3(loaded.world_from_lattice)))) / scene.unit;
}

int liquid_flatten(const LoadedMedium& loaded, int gradients, FlatScene& scene) {
  const MediumDesc& m = *loaded.desc;
  if (!is_liquid(m, LIQUID_LOCAL_LIGHTING)) return -1;
  const LiquidDesc& d = m.liquid;
  Liquid liquid{};
  liquid.diffuse = packed(d.light_intensity * d.albedo);
  liquid.specular = packed(d.specular);
  liquid.ambient = packed(d.ambient);
  liquid.shininess = static_cast<float>(d.shininess);
  liquid.outside = static_cast<float>(d.outside);
  liquid.inside = static_cast<float>(d.inside);
  liquid.rate = d.grazing_correction ? 0.0f : static_cast<float>(1 / voxel_size(loaded, scene));
  liquid.gradients = gradients;
  scene.liquids.push_back(liquid);
  return static_cast<int>(scene.liquids.size()) - 1;
}

// `per`: flat units of length, units of density.
MediumBody body_flatten(const LoadedMedium& loaded, int placed, double per) {
  const MediumDesc& d = *loaded.desc;
  MediumBody body{};
  coefficients_flatten(d, per, body);
  body.phase = d.phase;
  body.g = static_cast<float>(d.g);
  body.density = loaded.only_glows ? -1 : placed;
  body.glow = loaded.only_glows || d.emission != dvec3(0) ? placed : -1;
  return body;
}

// Of media and isosurfaces that show the same grid, the bricks of the first.
FlatDensity density_once(const LoadedMedium& loaded, bool needed_again, FlatGrids& grids, FlatScene& scene) {
  if (loaded.is_constant) return density_flatten(loaded, needed_again, scene);
  const auto key = std::make_tuple(loaded.grid.get(), loaded.desc->interpolation, int(loaded.desc->type));
  const auto known = grids.find(key);
  return known != grids.end() ? known->second : grids[key] = density_flatten(loaded, needed_again, scene);
}

constexpr double ISO_MARGIN = 1e-4;  // of the largest density

void isosurface_flatten(const LoadedIsosurface& loaded, bool needed_again, FlatGrids& grids, FlatScene& scene) {
  const FlatDensity density = density_once(loaded.placed, needed_again, grids, scene);
  const double largest = density.largest * density.unit;
  if (!(loaded.iso < largest))
    throw InputError(loaded.place + "/iso: " + number_text(loaded.iso) +
                     " is nowhere exceeded, the densities of the grid reach from 0 to " + number_text(largest) +
                     "; expected 0 < iso < " + number_text(largest));
  if (!(loaded.iso >= ISO_MARGIN * largest && loaded.iso <= (1 - ISO_MARGIN) * largest))
    throw InputError(loaded.place + "/iso: " + number_text(loaded.iso) +
                     " is so close to an end of the densities, 0 to " + number_text(largest) +
                     ", that single precision cannot tell where it is; expected " + number_text(ISO_MARGIN * largest) +
                     " to " + number_text((1 - ISO_MARGIN) * largest));
  const Medium& m = density.medium;
  const float iso = static_cast<float>(loaded.iso / density.unit);
  scene.isosurfaces.push_back({affine(cells_from_flat(loaded.placed, scene)), m.lo, iso, m.hi, m.brick_offset,
                               m.cells_x, m.cells_y, m.cells_z, m.brick_nx, m.brick_ny, m.brick_nz,
                               iso_masks_append(density.first_brick, density.bricks, iso, scene)});
}

void medium_flatten(const LoadedMedium& loaded, bool needed_again, FlatGrids& grids, FlatScene& scene) {
  const FlatDensity density = density_once(loaded, needed_again, grids, scene);
  MediumBody body = body_flatten(loaded, density_place(density, loaded, scene), scene.unit * density.unit);
  body.liquid = liquid_flatten(loaded, density.gradients, scene);
  const double largest = density.largest * density.unit;
  if (body.liquid >= 0 && largest < loaded.desc->liquid.outside)
    note_once(scene.notes, loaded.desc->place + ": the presence reaches " + number_text(largest) +
                               ", nowhere `outside`, " + number_text(loaded.desc->liquid.outside) +
                               ": the liquid is not seen");
  scene.media.push_back(body);
  scene.sizes.push_back({loaded.desc->place, medium_longest(loaded) / scene.unit, density.largest});
}

}  // namespace

std::vector<LoadedMedium> load_media(const SceneDesc& desc, LoadedScene& loaded, std::vector<std::string>& notes) {
  std::vector<LoadedMedium> media;
  for (const MediumRow& row : media_rows(desc)) media.push_back(load_medium(desc, row, loaded, notes));
  return media;
}

LoadedIsosurface load_isosurface(const SceneDesc& desc, const ShapeDesc& shape, LoadedScene& loaded,
                                 std::vector<std::string>& notes) {
  const auto& surface = std::get<IsosurfaceDesc>(shape.geometry);
  auto as_medium = std::make_shared<MediumDesc>();
  as_medium->density = *surface.density;
  as_medium->bounds = surface.bounds;
  as_medium->transform = surface.transform;
  return {load_grid(as_medium, false, 0, loaded, notes), surface.iso, desc.file.string() + ": " + shape.place};
}

void medium_bounds_add(const LoadedMedium& m, Bounds& bounds) {
  const double fade = medium_fade(m);
  const dvec3 lo(-fade), hi = medium_size(m) + fade;
  for (int corner = 0; corner < 8; ++corner)
    bounds.add(transform_point(m.world_from_lattice,
                               dvec3(corner & 1 ? hi.x : lo.x, corner & 2 ? hi.y : lo.y, corner & 4 ? hi.z : lo.z)));
}

void flatten_media(const std::vector<LoadedMedium>& media, const std::vector<LoadedIsosurface>& isosurfaces,
                   bool needed_again, FlatScene& scene) {
  FlatGrids grids;
  for (const LoadedIsosurface& surface : isosurfaces) isosurface_flatten(surface, needed_again, grids, scene);
  for (const LoadedMedium& m : media) medium_flatten(m, needed_again, grids, scene);
  const auto grey = [](const MediumBody& m) {
    const float x = m.sigma_a.x + m.sigma_s.x, y = m.sigma_a.y + m.sigma_s.y, z = m.sigma_a.z + m.sigma_s.z;
    return x == y && y == z;
  };
  const auto clear_grey = [](const Material& m) {
    return m.absorption.x == m.absorption.y && m.absorption.y == m.absorption.z;
  };
  scene.color_tau = !std::all_of(scene.media.begin(), scene.media.end(), grey) ||
                    !std::all_of(scene.materials.begin(), scene.materials.end(), clear_grey);
}

}  // namespace brume
