// Media: which method each uses, where its grid lies, its coefficients.
#include <algorithm>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>

#include "base/error.hpp"
#include "flat/flatten_parts.hpp"
#include "scene/families.hpp"

namespace brume {

namespace {

bool density_is_constant(const DensityDesc& d) {
  return d.type == "constant" || (d.type == "sphere" && d.of && d.of->type == "constant");
}

// What a method must fit for this medium: FITS_x bits, any of which will do.
int medium_fits(const MediumDesc& m) {
  return (m.interpolation == INTERPOLATION_NEAREST ? FITS_NEAREST : FITS_TRILINEAR) |
         (density_is_constant(m.density) ? FITS_CONSTANT : 0);
}

std::string methods_that_fit(int fits) {
  std::string names = "auto";
  for (const FamilyRow& row : method_family())
    if (method_fits(row.id) & fits) names += ", " + std::string(row.name);
  return names;
}

int method_exact(const MediumDesc& m) {
  if (m.density.type == "constant") return method_exact_of(FITS_CONSTANT);
  return method_exact_of(m.interpolation == INTERPOLATION_NEAREST ? FITS_NEAREST : FITS_TRILINEAR);
}

std::string method_name(int method) { return std::string(family_name(method_family(), method)); }

[[noreturn]] void refuse_method(const SceneDesc& desc, const std::string& place, int method, const MediumDesc& m) {
  throw InputError(desc.file.string() + ": " + place + "/method: '" + method_name(method) + "' does not fit the " +
                   std::string(family_name(interpolation_family(), m.interpolation)) + " density '" + m.density.type +
                   "' of " + m.place + "; these do: " + methods_that_fit(medium_fits(m)));
}

// A method of the medium's own has to fit it; where that of the picture does not, the medium takes its exact one.
int method_resolve(const SceneDesc& desc, const MediumDesc& m) {
  const int wanted = m.method.value_or(desc.render.method);
  if (wanted == METHOD_AUTO) return method_exact(m);
  if (method_fits(wanted) & medium_fits(m)) return wanted;
  if (m.method) refuse_method(desc, m.place, wanted, m);
  return method_exact(m);
}

// The media that take another method than the picture asks for, in one line; refused where all do that have none of their own.
void methods_tell(const SceneDesc& desc, const std::vector<LoadedMedium>& media, std::vector<std::string>& notes) {
  if (desc.render.method == METHOD_AUTO) return;
  std::string others;
  const LoadedMedium* first = nullptr;
  bool fits_one = false;
  for (const LoadedMedium& m : media) {
    if (m.desc->method) continue;
    fits_one = fits_one || m.method == desc.render.method;
    if (m.method == desc.render.method) continue;
    if (!first) first = &m;
    others += (others.empty() ? "" : ", ") + m.desc->place + " takes " + method_name(m.method);
  }
  if (!first) return;
  if (!fits_one) refuse_method(desc, "/render", desc.render.method, *first->desc);
  notes.push_back("/render/method: '" + method_name(desc.render.method) + "' does not fit all media: " + others);
}

double constant_value(const DensityDesc& d) { return d.of ? d.of->value : d.value; }

dmat4 lattice_onto_bounds(const std::array<dvec3, 2>& bounds, const dvec3& size) {
  dmat4 m(1.0);
  for (int axis = 0; axis < 3; ++axis) {
    m[axis][axis] = (bounds[1][axis] - bounds[0][axis]) / size[axis];
    m[3][axis] = bounds[0][axis];
  }
  return m;
}

// A grid of depths to the lights is for what scatters.
void refuse_useless_light_grid(const SceneDesc& desc) {
  const auto scatters = [](const MediumDesc& m) { return m.sigma_s != dvec3(0); };
  if (desc.render.shadow != SHADOW_GRID || desc.media.empty() ||
      std::any_of(desc.media.begin(), desc.media.end(), scatters))
    return;
  throw InputError(desc.file.string() + ": /render/shadow: 'grid' does not fit " + desc.media.front().place +
                   ", nor any other medium: sigma_s is 0, no light is scattered; allowed: trace, auto");
}

// Collisions differ from run to run of a light ray: frozen into a grid their noise would be an error that no number of samples
// mends.
void refuse_tracked_light_grid(const SceneDesc& desc, int method) {
  if (desc.render.shadow == SHADOW_GRID && method_draws(method) == DRAWS_COLLISIONS)
    throw InputError(desc.file.string() + ": /render/shadow: 'grid' does not fit the method '" +
                     std::string(family_name(method_family(), method)) +
                     "', whose error only falls over many light rays; allowed with it: trace, auto");
}

LoadedMedium load_medium(const SceneDesc& desc, const std::shared_ptr<const MediumDesc>& medium,
                         LoadedScene& loaded_scene, std::vector<std::string>& notes) {
  const MediumDesc& m = *medium;
  const int method = method_resolve(desc, m);
  refuse_tracked_light_grid(desc, method);
  LoadedMedium loaded{medium, method, m.step.value_or(desc.render.step), false, false, false, 0, nullptr, dmat4(1.0)};
  const std::array<dvec3, 2> unit{dvec3(-1), dvec3(1)};
  const dmat4 transform = transform_matrix(m.transform);
  if (loaded.method == METHOD_HOMOGENEOUS) {
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

// How far the medium reaches beyond its lattice [0, size], in voxels: a trilinear field with zero outside fades over half a voxel more.
double medium_reach(const LoadedMedium& m) {
  return m.grid && m.grid->border == Border::ZERO && m.desc->interpolation == INTERPOLATION_TRILINEAR ? 0.5 : 0.0;
}

dvec3 medium_size(const LoadedMedium& m) { return m.grid ? dvec3(m.grid->size()) : dvec3(1); }

double longest_side(const LoadedMedium& m) {
  const dvec3 size = medium_size(m) + 2 * medium_reach(m);
  double longest = 0;
  for (int axis = 0; axis < 3; ++axis)
    longest = std::max(longest, glm::length(dvec3(m.world_from_lattice[axis])) * size[axis]);
  return longest;
}

// The rate at which trackers collide, per density: the largest extinction. A medium that only glows has none: eight collisions on
// the longest way (flat units) through its densest part then, else its light would never be sampled.
double track_sigma_of(const MediumBody& m, double longest, float density_max) {
  const double largest = std::max({m.sigma_a.x + m.sigma_s.x, m.sigma_a.y + m.sigma_s.y, m.sigma_a.z + m.sigma_s.z});
  return largest > 0 || !(density_max > 0) ? largest : 8 / (longest * density_max);
}

// A density in the flat scene, before it stands anywhere: a grid, or one value.
struct FlatDensity {
  Medium medium;      // its geometry in cell space
  int grid = -1;      // of FlatScene::grids
  double unit = 1;    // of the densities stored
  float largest = 0;  // in that unit
};

// Grids already in bricks, by grid and interpolation: the padding depends on that.
using FlatGrids = std::map<std::pair<const Grid*, int>, FlatDensity>;

FlatDensity density_flatten(const LoadedMedium& loaded, FlatScene& scene) {
  FlatDensity density{};
  Medium& medium = density.medium;
  medium.interpolation = loaded.desc->interpolation;
  medium.region = loaded.sphere ? REGION_SPHERE : REGION_BOX;
  medium.is_constant = loaded.is_constant;
  medium.constant_density = static_cast<float>(loaded.constant);
  medium.hi = {1, 1, 1};
  const std::size_t first_voxel = scene.voxels.size();
  density.grid = -1;
  if (!loaded.is_constant) {
    bricks_append(*loaded.grid, medium, scene);
    density.grid = static_cast<int>(scene.grids.size());
    scene.grids.push_back({medium.brick_offset, medium.cells_x, medium.cells_y, medium.cells_z, medium.brick_nx,
                           medium.brick_ny, medium.brick_nz});
  }
  density.unit = densities_scale(medium, first_voxel, scene);
  density.largest = density_max(medium, scene);
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
  const auto same = [&](const PlacedGrid& other) { return std::memcmp(&other, &placed, sizeof placed) == 0; };
  const auto known = std::find_if(scene.placed.begin(), scene.placed.end(), same);
  if (known != scene.placed.end()) return static_cast<int>(known - scene.placed.begin());
  scene.placed.push_back(placed);
  return static_cast<int>(scene.placed.size()) - 1;
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

void medium_flatten(const LoadedMedium& loaded, FlatGrids& grids, FlatScene& scene) {
  const auto key = std::make_pair(loaded.grid.get(), loaded.desc->interpolation);
  const auto known = loaded.is_constant ? grids.end() : grids.find(key);
  const FlatDensity density = known != grids.end() ? known->second : density_flatten(loaded, scene);
  if (!loaded.is_constant) grids[key] = density;
  scene.media.push_back(body_flatten(loaded, density_place(density, loaded, scene), scene.unit * density.unit));
  const double longest = longest_side(loaded) / scene.unit;
  MediumWalk walk{loaded.method, static_cast<float>(loaded.step * longest), 0, -1};
  if (!loaded.is_constant)
    walk.track_sigma = static_cast<float>(track_sigma_of(scene.media.back(), longest, density.largest));
  scene.walks.push_back(walk);
}

}  // namespace

std::vector<LoadedMedium> load_media(const SceneDesc& desc, LoadedScene& loaded, std::vector<std::string>& notes) {
  refuse_useless_light_grid(desc);
  std::vector<LoadedMedium> media;
  for (const MediumDesc& m : desc.media) {
    auto body = std::make_shared<MediumDesc>(m);
    if (m.emission_density) {  // a medium of its own that only glows
      auto glow = std::make_shared<MediumDesc>(m);
      glow->density = *m.emission_density;
      glow->place += "/emission_density";
      if (m.method && *m.method != METHOD_AUTO && !(method_fits(*m.method) & medium_fits(*glow)))
        glow->method = METHOD_AUTO;  // it is said for the density
      glow->sigma_a = glow->sigma_s = body->emission = dvec3(0);
      media.push_back(load_medium(desc, glow, loaded, notes));
      media.back().only_glows = true;
    }
    media.push_back(load_medium(desc, body, loaded, notes));
  }
  methods_tell(desc, media, notes);
  return media;
}

void medium_bounds_add(const LoadedMedium& m, Bounds& bounds) {
  const double reach = medium_reach(m);
  const dvec3 lo(-reach), hi = medium_size(m) + reach;
  for (int corner = 0; corner < 8; ++corner)
    bounds.add(transform_point(m.world_from_lattice,
                               dvec3(corner & 1 ? hi.x : lo.x, corner & 2 ? hi.y : lo.y, corner & 4 ? hi.z : lo.z)));
}

void flatten_media(const SceneDesc& desc, const std::vector<LoadedMedium>& media, FlatScene& scene) {
  FlatGrids grids;
  for (const LoadedMedium& m : media) {
    medium_flatten(m, grids, scene);
    scene.walks.back().light_grids = light_grids_append(desc, scene.medium(scene.media.size() - 1), scene);
    scene.places.push_back(m.desc->place);
  }
  voxels_pack(scene, desc.render.storage);
  const auto grey = [](const MediumBody& m) {
    const float x = m.sigma_a.x + m.sigma_s.x, y = m.sigma_a.y + m.sigma_s.y, z = m.sigma_a.z + m.sigma_s.z;
    return x == y && y == z;
  };
  scene.color_tau = !std::all_of(scene.media.begin(), scene.media.end(), grey);
  for (const MediumWalk& walk : scene.walks) scene.draws |= 1u << method_draws(walk.method);
  scene.frame.takes_ends = !((scene.draws >> DRAWS_COLLISIONS) & 1u);
  scene.frame.medium_count = static_cast<int>(scene.media.size());
}

}  // namespace brume
