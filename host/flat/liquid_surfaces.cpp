// Liquids of the model `surface` as the shapes that they are.
#include <algorithm>

#include "flat/flatten_parts.hpp"

namespace brume {

namespace {

constexpr double WATER_IOR = 1.33;

// What the liquid names, else water; it absorbs what the medium says, beside its own.
MaterialDesc material_of(const MediumDesc& liquid, const SceneDesc& desc) {
  MaterialDesc material;
  if (liquid.liquid.material >= 0) {
    material = desc.materials[static_cast<std::size_t>(liquid.liquid.material)];
  } else {
    material.name = "water";
    material.diffuse = dvec3(0);
    material.refraction = 1;
    material.ior = WATER_IOR;
    material.fresnel = true;
  }
  material.absorption += liquid.sigma_a;
  return material;
}

}  // namespace

SceneDesc liquids_as_shapes(const SceneDesc& desc) {
  SceneDesc out = desc;
  for (const MediumDesc& m : desc.media) {
    if (!is_liquid(m, LIQUID_SURFACE)) continue;
    const IsosurfaceDesc surface{std::make_shared<DensityDesc>(m.density), m.liquid.iso, m.bounds, m.transform};
    out.shapes.push_back({surface, static_cast<int>(out.materials.size()), m.place});
    out.materials.push_back(material_of(m, desc));
  }
  return out;
}

}  // namespace brume
