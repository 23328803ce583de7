// See families.hpp.
#include "scene/families.hpp"

#include "scene/scene_desc.hpp"
#include "shared/frame.h"
#include "shared/shape.h"

namespace brume {

#define FAMILY(function, LIST)           \
  const Family& function() {             \
    static const Family rows{LIST(ROW)}; \
    return rows;                         \
  }

#define ROW(id, name, help) {CAMERA_##id, name, help},
FAMILY(camera_family, BRUME_CAMERAS)
#undef ROW
#define ROW(id, name, help) {LIGHT_##id, #name, help},
FAMILY(light_family, BRUME_LIGHTS)
#undef ROW
#define ROW(id, name, help) {FALLOFF_##id, name, help},
FAMILY(falloff_family, BRUME_FALLOFFS)
#undef ROW
#define ROW(id, name, help) {BVH_##id, #name, help},
FAMILY(bvh_family, BRUME_BVH_RULES)
#undef ROW
#define ROW(id, name, help) {INTEGRATOR_##id, name, help},
FAMILY(integrator_family, BRUME_INTEGRATORS)
#undef ROW
#define ROW(id, name, help) {LIGHT_POINTS_##id, name, help},
FAMILY(light_points_family, BRUME_LIGHT_POINTS)
#undef ROW
#define ROW(id, name, help) {MATERIAL_##id, name, help},
FAMILY(material_family, BRUME_MATERIALS)
#undef ROW
#define ROW(id, name, help) {TEXTURE_##id, name, help},
FAMILY(texture_family, BRUME_TEXTURES)
#undef ROW
#define ROW(id, name, help) {WRAP_##id, name, help},
FAMILY(wrap_family, BRUME_WRAPS)
#undef ROW
#define ROW(id, name, takes_g, help) {PHASE_##id, #name, help},
FAMILY(phase_family, BRUME_PHASES)
#undef ROW
#define ROW(id, name, help) {INTERPOLATION_##id, name, help},
FAMILY(interpolation_family, BRUME_INTERPOLATIONS)
#undef ROW
#define ROW(id, name, help) {IN_SCATTERING_##id, name, help},
FAMILY(in_scattering_family, BRUME_IN_SCATTERINGS)
#undef ROW
#define ROW(id, name, help) {SHADOW_##id, name, help},
FAMILY(shadow_family, BRUME_SHADOWS)
#undef ROW
#define ROW(id, name, help) {METRIC_##id, name, help},
FAMILY(error_metric_family, BRUME_ERROR_METRICS)
#undef ROW
#define ROW(id, name, help) {MEDIUM_##id, name, help},
FAMILY(medium_family, BRUME_MEDIUM_TYPES)
#undef ROW
#define ROW(id, name, help) {LIQUID_##id, name, help},
FAMILY(liquid_model_family, BRUME_LIQUID_MODELS)
#undef ROW
#define ROW(id, name, help) {PRESENCE_##id, name, help},
FAMILY(presence_family, BRUME_PRESENCE_RULES)
#undef ROW
#define ROW(id, name, help) {TRANSFER_##id, name, help},
FAMILY(transfer_family, BRUME_TRANSFERS)
#undef ROW
#define ROW(id, name, help) {STORAGE_##id, name, help},
FAMILY(storage_family, BRUME_STORAGES)
#undef ROW
#define ROW(id, name, fits, placement, rule, share, jitter, draws, exact, help) {METHOD_##id, name, help},
FAMILY(method_family, BRUME_METHODS)
#undef ROW
#undef FAMILY

bool phase_takes_g(int phase) {
#define ROW(id, name, takes_g, help) \
  if (phase == PHASE_##id) return takes_g;
  BRUME_PHASES(ROW)
#undef ROW
  return false;
}

const Family& shape_family() {
  static const Family rows{
#define ROW(id, name, help) {SHAPE_##id, #name, help},
      BRUME_SHAPES(ROW)
#undef ROW
          {SHAPE_COUNT, "triangle", "three vertices"},
      {SHAPE_COUNT + 1, "mesh", "a file of triangles"}};
  return rows;
}

const Family& mesh_shading_family() {
  static const Family rows{
      {static_cast<int>(MeshShading::FLAT), "flat", "one normal per triangle"},
      {static_cast<int>(MeshShading::PHONG), "phong", "normals blended over the triangle"},
      {static_cast<int>(MeshShading::GOURAUD), "gouraud", "light of the vertices blended over the triangle"}};
  return rows;
}

const Family& level_set_family() {
  static const Family rows{{LEVEL_SET_REFUSE, "refuse", "level sets are no densities"},
                           {LEVEL_SET_FILL, "fill", "1 inside, 0 outside"}};
  return rows;
}

const Family& negative_family() {
  static const Family rows{{NEGATIVE_REFUSE, "refuse", "no negative densities"},
                           {NEGATIVE_CLAMP, "clamp", "those that are rounding become 0"}};
  return rows;
}

const Family& glass_shadow_family() {
  static const Family rows{{GLASS_OPAQUE, "opaque", "shapes that refract block light"},
                           {GLASS_CLEAR, "clear", "light passes them straight on, weakened"}};
  return rows;
}

}  // namespace brume
