// Media: which method each uses, where its grid lies, its coefficients.
#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "base/error.hpp"
#include "flat/flatten_parts.hpp"
#include "scene/families.hpp"
#include "volume/density_source.hpp"

namespace brume {

namespace {

DensitySpec density_spec(const DensityDesc& d) {
  DensitySpec spec;
  spec.type = d.type;
  spec.resolution = d.resolution;
  spec.value = d.value;
  spec.scale = d.scale;
  spec.octaves = d.octaves;
  spec.seed = d.seed;
  spec.file = d.file;
  spec.grid = d.grid;
  spec.values = {d.level_set == LEVEL_SET_FILL, d.threshold, d.remap, d.factor, d.negative == NEGATIVE_CLAMP};
  if (d.of) spec.of = std::make_shared<DensitySpec>(density_spec(*d.of));
  return spec;
}

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

int method_resolve(const SceneDesc& desc, const MediumDesc& m) {
  const int fits = medium_fits(m);
  if (desc.render.method == METHOD_AUTO) {
    if (m.density.type == "constant") return method_exact_of(FITS_CONSTANT);
    return method_exact_of(m.interpolation == INTERPOLATION_NEAREST ? FITS_NEAREST : FITS_TRILINEAR);
  }
  if (!(method_fits(desc.render.method) & fits))
    throw InputError(desc.file.string() + ": /render/method: '" +
                     std::string(family_name(method_family(), desc.render.method)) + "' does not fit the " +
                     std::string(family_name(interpolation_family(), m.interpolation)) + " density '" + m.density.type +
                     "' of " + m.place + "; these do: " + methods_that_fit(fits));
  return desc.render.method;
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

// Collisions differ from run to run of a light ray: frozen into a grid their noise would be an error that no number of samples
// mends.
void refuse_tracked_light_grid(const SceneDesc& desc, int method) {
  if (desc.render.shadow == SHADOW_GRID && method_draws(method) == DRAWS_COLLISIONS)
    throw InputError(desc.file.string() + ": /render/shadow: 'grid' does not fit the method '" +
                     std::string(family_name(method_family(), method)) +
                     "', whose error only falls over many light rays; allowed with it: trace, auto");
}

LoadedMedium load_medium(const SceneDesc& desc, const std::shared_ptr<const MediumDesc>& medium,
                         std::vector<std::string>& notes) {
  const MediumDesc& m = *medium;
  refuse_tracked_light_grid(desc, method_resolve(desc, m));
  LoadedMedium loaded{medium, method_resolve(desc, m), false, false, 0, std::nullopt, dmat4(1.0)};
  const std::array<dvec3, 2> unit{dvec3(-1), dvec3(1)};
  const dmat4 transform = transform_matrix(m.transform);
  if (loaded.method == METHOD_HOMOGENEOUS) {
    loaded.is_constant = true;
    loaded.sphere = m.density.type == "sphere";
    loaded.constant = constant_value(m.density);
    loaded.world_from_lattice = transform * lattice_onto_bounds(m.bounds.value_or(unit), dvec3(1));
    return loaded;
  }
  loaded.grid = density_make(density_spec(m.density));
  for (const std::string& note : loaded.grid->notes)
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
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
double track_sigma_of(const Medium& m, double longest, float density_max) {
  const double largest = std::max({m.sigma_a.x + m.sigma_s.x, m.sigma_a.y + m.sigma_s.y, m.sigma_a.z + m.sigma_s.z});
  return largest > 0 || !(density_max > 0) ? largest : 8 / (longest * density_max);
}

Medium medium_flatten(const SceneDesc& desc, LoadedMedium& loaded, FlatScene& scene) {
  const MediumDesc& d = *loaded.desc;
  Medium medium{};
  medium.interpolation = d.interpolation;
  medium.phase = d.phase;
  medium.g = static_cast<float>(d.g);
  medium.method = loaded.method;
  medium.region = loaded.sphere ? REGION_SPHERE : REGION_BOX;
  medium.is_constant = loaded.is_constant;
  medium.constant_density = static_cast<float>(loaded.constant);
  const double longest = longest_side(loaded) / scene.unit;
  medium.step = static_cast<float>(desc.render.step * longest);

  dmat4 cell_from_world = glm::inverse(flat_from(scene, loaded.world_from_lattice));
  const std::size_t first_voxel = scene.voxels.size();
  medium.hi = {1, 1, 1};
  if (!loaded.is_constant) bricks_append(std::move(*loaded.grid), medium, scene);
  coefficients_flatten(d, scene.unit * densities_scale(medium, first_voxel, scene), medium);
  if (!loaded.is_constant) {
    medium.track_sigma = static_cast<float>(track_sigma_of(medium, longest, density_max(medium, first_voxel, scene)));
    if (d.interpolation == INTERPOLATION_TRILINEAR)
      cell_from_world[3] += glm::dvec4(0.5, 0.5, 0.5, 0.0);  // see bricks_append
  }
  medium.cell_from_world = affine(cell_from_world);
  medium.world_from_cell = affine(glm::inverse(cell_from_world));
  light_grids_append(desc, medium, scene);
  return medium;
}

}  // namespace

std::vector<LoadedMedium> load_media(const SceneDesc& desc, std::vector<std::string>& notes) {
  std::vector<LoadedMedium> media;
  for (const MediumDesc& m : desc.media) {
    auto body = std::make_shared<MediumDesc>(m);
    if (m.emission_density) {  // a medium of its own that only glows
      auto glow = std::make_shared<MediumDesc>(m);
      glow->density = *m.emission_density;
      glow->sigma_a = glow->sigma_s = body->emission = dvec3(0);
      media.push_back(load_medium(desc, glow, notes));
    }
    media.push_back(load_medium(desc, body, notes));
  }
  return media;
}

void medium_bounds_add(const LoadedMedium& m, Bounds& bounds) {
  const double reach = medium_reach(m);
  const dvec3 lo(-reach), hi = medium_size(m) + reach;
  for (int corner = 0; corner < 8; ++corner)
    bounds.add(transform_point(m.world_from_lattice,
                               dvec3(corner & 1 ? hi.x : lo.x, corner & 2 ? hi.y : lo.y, corner & 4 ? hi.z : lo.z)));
}

void flatten_media(const SceneDesc& desc, std::vector<LoadedMedium>& media, FlatScene& scene) {
  for (LoadedMedium& m : media) scene.media.push_back(medium_flatten(desc, m, scene));
  voxels_pack(scene, desc.render.storage);
  const auto grey = [](const Medium& m) {
    const float x = m.sigma_a.x + m.sigma_s.x, y = m.sigma_a.y + m.sigma_s.y, z = m.sigma_a.z + m.sigma_s.z;
    return x == y && y == z;
  };
  scene.color_tau = !std::all_of(scene.media.begin(), scene.media.end(), grey);
  for (const Medium& m : scene.media) scene.draws |= 1u << method_draws(m.method);
  scene.frame.takes_ends = !((scene.draws >> DRAWS_COLLISIONS) & 1u);
  scene.frame.medium_count = static_cast<int>(scene.media.size());
  scene.method = media.empty() ? METHOD_HOMOGENEOUS : media.front().method;
}

}  // namespace brume
