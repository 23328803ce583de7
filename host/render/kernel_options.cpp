// See kernel_options.hpp.
#include "render/kernel_options.hpp"

#include <algorithm>

#include "shared/method.h"

namespace brume {

namespace {

template <class Items, class Key>
unsigned bits_used(const Items& items, Key key) {
  unsigned bits = 0;
  for (const auto& item : items) bits |= 1u << key(item);
  return bits;
}

constexpr unsigned all_bits(int count) { return (1u << count) - 1; }

// As adaptive_joins in kernels/media/scatter.cl; false for other methods.
bool walks_alone(const FlatScene& scene, const MediumWalk& walk, std::size_t medium) {
  const Medium m = medium_of(scene, walk, medium);
  const auto some = [](const Packed3& v) { return std::max({v.x, v.y, v.z}) > 0; };
  if (!method_has_tolerance(walk.method)) return false;
  return m.is_constant || (some(m.sigma_s) ? m.light_grids < 0 : !some(m.emission));
}

// What BRUME_MEDIA says of several media.
unsigned media_option(const FlatScene& scene, const std::vector<MediumWalk>& walks) {
  const auto walked = std::count_if(walks.begin(), walks.end(),
                                    [](const MediumWalk& walk) { return method_rule(walk.method) != RULE_PRODUCT; });
  bool alone = false;
  for (std::size_t i = 0; i < walks.size(); ++i) alone = alone || walks_alone(scene, walks[i], i);
  if (walks.size() < 2) return static_cast<unsigned>(walks.size());
  return walked < 2 || alone ? 2 : walks.size() <= MEDIA_TOGETHER ? 3 : 4;
}

}  // namespace

std::vector<KernelOption> scene_kernel_options(const FlatScene& s, const RenderPlan& plan) {
  const unsigned methods = bits_used(plan.walks, [](const MediumWalk& w) { return w.method; });
  const unsigned regions = bits_used(s.placed, [](const PlacedGrid& p) { return p.region; });
  const unsigned phases = bits_used(s.media, [](const MediumBody& m) { return m.phase; });
  const unsigned shapes = bits_used(s.shapes, [](const Shape& shape) { return shape.type; });
  const unsigned lights = bits_used(plan.lights, [](const Light& l) { return l.type; });
  unsigned rules = 0;
  for (const MediumWalk& w : plan.walks)
    rules |= 1u << (method_has_tolerance(w.method) ? IN_SCATTERING_GAUSS2 : plan.frame.in_scattering);
  return {
      {"MEDIA", media_option(s, plan.walks), 4, "media"},
      {"COLOR_TAU", static_cast<unsigned>(s.color_tau), 1, "an optical depth for each channel"},
      {"METHODS_USED", methods, all_bits(METHOD_COUNT), "methods"},
      {"JITTER", (plan.draws >> DRAWS_PLACES) & 1u, 1, "random places in steps"},
      {"TRACKING", (plan.draws >> DRAWS_COLLISIONS) & 1u, 1, "random collisions"},
      {"ROULETTE", plan.frame.roulette > 0, 1, "roulette"},
      {"SPHERE_REGION", (regions >> REGION_SPHERE) & 1u, 1, "media cut to spheres"},
      {"LIQUID", !s.liquids.empty(), 1, "liquids"},
      {"LIGHT_GRID", plan.light_entries > 0, 1, "light grids"},
      {"IN_SCATTERINGS_USED", rules, all_bits(IN_SCATTERING_COUNT), "rules of in-scattering"},
      {"PHASES_USED", phases, all_bits(PHASE_COUNT), "phase functions"},
      {"SHAPES_USED", shapes, all_bits(SHAPE_COUNT), "shapes"},
      {"SHAPE_BVH", s.shape_root >= 0, 1, "a BVH over shapes"},
      {"TRIANGLES", !s.triangles.empty(), 1, "triangles"},
      {"INSTANCES", !s.instances.empty(), 1, "instances"},
      {"GOURAUD", scene_blends_light(s), 1, "light of corners"},
      {"TEXTURED", !s.textures.empty(), 1, "textures"},
      {"SPECULAR", scene_is_specular(s), 1, "mirrors and glass"},
      {"AMBIENT_OCCLUSION", plan.frame.directions > 0, 1, "ambient occlusion"},
      {"CLEAR_SHADOWS", plan.frame.clear_shadows && scene_is_specular(s), 1, "light through glass"},
      {"STARTS_INSIDE", static_cast<unsigned>(plan.frame.starts_inside), 1, "a camera inside of glass"},
      {"LIGHTS_CHOSEN", plan.frame.light_picks < plan.frame.light_count, 1, "lights chosen at random"},
      {"LIGHTS_USED", lights, all_bits(LIGHT_TYPES), "lights"},
  };
}

std::string option_text(const char* name, unsigned value) {
  return std::string(" -DBRUME_") + name + "=" + std::to_string(value);
}

bool scene_blends_light(const FlatScene& scene) {
  return std::any_of(scene.triangles.begin(), scene.triangles.end(),
                     [](const Triangle& t) { return t.shading == TRIANGLE_GOURAUD; });
}

bool scene_is_specular(const FlatScene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const Material& m) { return m.reflection > 0 || m.refraction > 0; });
}

std::string kernel_options(const FlatScene& scene, const RenderPlan& plan, const DeviceInfo& device, int lanes,
                           bool generic) {
  std::string text = option_text("LANES", static_cast<unsigned>(lanes)) +
                     option_text("BVH_WIDTH", static_cast<unsigned>(scene.bvh_width)) +
                     option_text("FAST_FMA", device.fast_fma) +
                     option_text("STORAGE", static_cast<unsigned>(scene.voxels.empty() ? STORAGE_F32 : plan.storage)) +
                     option_text("OUTLINE", device.cpu) + option_text("BUILTINS", device.pocl_3_1);
  if (device.pocl_3_1) text += " -D_OPENCL_H_";  // what its own header says when it has been read
  if (generic) return text;
  for (const KernelOption& option : scene_kernel_options(scene, plan)) text += option_text(option.name, option.value);
  return text;
}

}  // namespace brume
