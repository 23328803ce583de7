// See row_scenes.hpp.
#include "check/row_scenes.hpp"

#include <iterator>
#include <utility>

#include "base/error.hpp"
#include "check/check_parts.hpp"
#include "load/loaded_scene.hpp"
#include "plan/planned_scene.hpp"
#include "scene/families.hpp"
#include "shared/shape.h"

namespace brume {

namespace {

constexpr int INTERPOLATION_FITS[] = {FITS_NEAREST, FITS_TRILINEAR};
static_assert(std::size(INTERPOLATION_FITS) == INTERPOLATION_COUNT, "one entry per row of BRUME_INTERPOLATIONS");

using Geometry = decltype(ShapeDesc::geometry);
static_assert(std::variant_size_v<Geometry> == SHAPE_COUNT + 2, "the rows of BRUME_SHAPES, then triangle and mesh");

template <std::size_t... I>
Geometry geometry_default(int type, std::index_sequence<I...>) {
  const Geometry all[] = {Geometry(std::in_place_index<I>)...};
  return all[type];
}

}  // namespace

std::vector<DensityKind> density_kinds() {
  std::vector<DensityKind> kinds;
  for (const FamilyRow& row : interpolation_family())
    kinds.push_back({std::string(row.name), INTERPOLATION_FITS[row.id], row.id});
  kinds.push_back({"presence", FITS_PRESENCE, INTERPOLATION_TRILINEAR});
  kinds.push_back({"constant", FITS_CONSTANT, INTERPOLATION_TRILINEAR});
  return kinds;
}

// Primes above the number of steps along any ray: from face to face, no sample of equal steps lies on a voxel's face
// by itself, where rounding would choose the voxel.
DensityDesc density_of(const std::string& type) {
  DensityDesc d;
  d.type = type;
  d.resolution = {31, 29, 37};
  d.scale = 3;
  d.octaves = 2;
  d.seed = 7;
  d.value = 0.75;
  if (type == "sphere") d.of = std::make_shared<DensityDesc>(density_of("perlin"));
  return d;
}

SceneDesc fog_desc(const DensityKind& kind, int method) {
  MediumDesc fog;
  fog.place = "/media/0";
  fog.interpolation = kind.interpolation;
  fog.density = density_of(kind.fits == FITS_CONSTANT ? "constant" : "perlin");
  fog.sigma_a = {0.2, 0.5, 1};
  fog.sigma_s = {2, 1.5, 1};
  fog.emission = {0, 0.05, 0.1};
  fog.phase = PHASE_HENYEY_GREENSTEIN;
  fog.g = 0.6;
  if (kind.fits == FITS_PRESENCE) {
    fog.type = MEDIUM_LIQUID;
    fog.sigma_s = fog.emission = dvec3(0);
    fog.liquid.outside = 0.4;
    fog.liquid.specular = {0.3, 0.5, 0.7};
    fog.density.presence = PRESENCE_REFUSE;
  }
  LightDesc sun, lamp;
  sun.type = LIGHT_DIRECTIONAL;
  sun.direction = {-0.4, -1, -0.6};
  sun.intensity = dvec3(2);
  lamp.position = {0.4, 0.6, 0.5};
  SceneDesc desc;
  desc.camera.eye = {1.8, 0.8, 2.9};
  desc.lights = {sun, lamp};
  desc.media = {fog};
  desc.render.method = method;
  // A decision that rounding turns (is this point too faint to be asked?) costs a share of the tolerance.
  desc.render.tolerance = 2e-4;
  desc.render.step = 0.07;
  desc.render.light_grid = 9;
  return desc;
}

SceneDesc shape_desc(int type) {
  SceneDesc desc = check_scene_desc("surfaces");
  std::vector<ShapeDesc> kept;
  for (const ShapeDesc& shape : desc.shapes)
    if (shape.geometry.index() == static_cast<std::size_t>(type)) kept.push_back(shape);
  if (kept.empty())
    kept.push_back({geometry_default(type, std::make_index_sequence<std::variant_size_v<Geometry>>()), 0, "/shapes/0"});
  desc.shapes = kept;
  return desc;
}

SceneDesc lights_desc(int type) {
  SceneDesc desc = check_scene_desc("surfaces");
  desc.lights.clear();
  CheckRandom random;
  for (int i = 0; i < 8; ++i) {
    LightDesc light;
    light.type = type;
    light.falloff = i % FALLOFF_COUNT;
    light.position = 3.5 * random.direction();  // outside of the points, on which a light would have no direction
    light.direction = random.direction();
    light.intensity = {3, 2 + 0.2 * i, 1};
    light.angle = 10 + 9 * i;
    light.softness = i / 7.0;
    desc.lights.push_back(light);
  }
  return desc;
}

SceneDesc material_desc(int model) {
  MaterialDesc material;
  material.model = model;
  material.diffuse = {0.5, 0.4, 0.3};
  material.specular = {0.4, 0.5, 0.6};
  material.shininess = 20;
  SceneDesc desc;
  desc.materials = {material};
  desc.shapes = {{SphereDesc{}, 0, "/shapes/0"}};
  return desc;
}

PlannedScene row_scene(SceneDesc desc, const std::string& name, int size, int bvh_width) {
  desc.file = name + ".json";
  desc.film.size = {size, size};
  LoadedScene loaded = check_meshes();
  loaded.needed_again = false;
  return flatten(desc, loaded, {bvh_width, {}});
}

}  // namespace brume
