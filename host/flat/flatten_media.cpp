// Media: where the grid of each lies, its coefficients.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>

#include "base/error.hpp"
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

LoadedMedium load_medium(const SceneDesc& desc, const MediumRow& row, LoadedScene& loaded_scene,
                         std::vector<std::string>& notes) {
  const MediumDesc& m = *row.desc;
  LoadedMedium loaded{row.desc, false, false, row.only_glows, 0, nullptr, dmat4(1.0)};
  const std::array<dvec3, 2> unit{dvec3(-1), dvec3(1)};
  const dmat4 transform = transform_matrix(m.transform);
  if (takes_constant(desc, m)) {
    loaded.is_constant = true;
    loaded.sphere = m.density.type == "sphere";
    loaded.constant = constant_value(m.density);
    loaded.world_from_lattice = transform * lattice_onto_bounds(m.bounds.value_or(unit), dvec3(1));
    return loaded;
  }
  loaded.grid = loaded_scene.grid(m.density);
  for (const std::string& note : loaded.grid->notes) note_once(notes, note);
  const dvec3 size(loaded.grid->size());
  const bool own = m.density.type == "file" && !m.bounds;
  loaded.world_from_lattice =
      transform * (own ? loaded.grid->world_from_lattice : lattice_onto_bounds(m.bounds.value_or(unit), size));
  return loaded;
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
  Medium medium;      // its geometry in cell space
  int grid = -1;      // of FlatScene::grids
  double unit = 1;    // of the densities stored
  float largest = 0;  // in that unit
  int gradients = 0;  // of a liquid: Liquid::gradients
};

// Grids already in bricks, by grid and interpolation: the padding depends on that.
using FlatGrids = std::map<std::pair<const Grid*, int>, FlatDensity>;

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
  return density;
}

// Where a density stands; media that stand on one spot share the row.
int density_place(const FlatDensity& density, const LoadedMedium& loaded, FlatScene& scene) {
  dmat4 cell_from_world = glm::inverse(flat_from(scene, loaded.world_from_lattice));
  if (!loaded.is_constant && loaded.desc->interpolation == INTERPOLATION_TRILINEAR)
    cell_from_world[3] += glm::dvec4(0.5, 0.5, 0.5, 0.0);  // see bricks_append
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

void medium_flatten(const LoadedMedium& loaded, bool needed_again, FlatGrids& grids, FlatScene& scene) {
  const auto key = std::make_pair(loaded.grid.get(), loaded.desc->interpolation);
  const auto known = loaded.is_constant ? grids.end() : grids.find(key);
  const FlatDensity density = known != grids.end() ? known->second : density_flatten(loaded, needed_again, scene);
  if (!loaded.is_constant) grids[key] = density;
  MediumBody body = body_flatten(loaded, density_place(density, loaded, scene), scene.unit * density.unit);
  body.liquid = liquid_flatten(loaded, density.gradients, scene);
  scene.media.push_back(body);
  scene.sizes.push_back({loaded.desc->place, medium_longest(loaded) / scene.unit, density.largest});
}

}  // namespace

std::vector<LoadedMedium> load_media(const SceneDesc& desc, LoadedScene& loaded, std::vector<std::string>& notes) {
  std::vector<LoadedMedium> media;
  for (const MediumRow& row : media_rows(desc)) media.push_back(load_medium(desc, row, loaded, notes));
  return media;
}

void medium_bounds_add(const LoadedMedium& m, Bounds& bounds) {
  const double fade = medium_fade(m);
  const dvec3 lo(-fade), hi = medium_size(m) + fade;
  for (int corner = 0; corner < 8; ++corner)
    bounds.add(transform_point(m.world_from_lattice,
                               dvec3(corner & 1 ? hi.x : lo.x, corner & 2 ? hi.y : lo.y, corner & 4 ? hi.z : lo.z)));
}

void flatten_media(const std::vector<LoadedMedium>& media, bool needed_again, FlatScene& scene) {
  FlatGrids grids;
  for (const LoadedMedium& m : media) medium_flatten(m, needed_again, grids, scene);
  const auto grey = [](const MediumBody& m) {
    const float x = m.sigma_a.x + m.sigma_s.x, y = m.sigma_a.y + m.sigma_s.y, z = m.sigma_a.z + m.sigma_s.z;
    return x == y && y == z;
  };
  scene.color_tau = !std::all_of(scene.media.begin(), scene.media.end(), grey);
}

}  // namespace brume
