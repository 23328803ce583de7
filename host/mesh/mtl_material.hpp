// A material as its MTL states it → as brume shows it.
#pragma once
#include <optional>

#include "mesh/mesh.hpp"
#include "mesh/text_lines.hpp"

namespace brume {

// What stands between two newmtl lines; empty where nothing was said.
struct MtlMaterial {
  std::string name;
  std::size_t line = 0;  // of newmtl
  std::optional<glm::dvec3> diffuse, specular, ambient, emission, filter;
  std::optional<double> shininess, ior, dissolve, transparency, illum;
  MeshTexture diffuse_map, emission_map;
};

// The nearest that brume has; what differs is told.
MeshMaterial mtl_material(const MtlMaterial& m, LineNotes& notes);

}  // namespace brume
