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

std::string define(const char* name, unsigned value) {
  return std::string(" -DBRUME_") + name + "=" + std::to_string(value);
}

std::string scene_options(const FlatScene& s, const RenderPlan& plan) {
  return define("MEDIA", static_cast<unsigned>(std::min<std::size_t>(s.media.size(), 2))) +
         define("COLOR_TAU", s.color_tau) +
         define("METHODS_USED", bits_used(plan.walks, [](const MediumWalk& w) { return w.method; })) +
         define("JITTER", (plan.draws >> DRAWS_PLACES) & 1u) +
         define("TRACKING", (plan.draws >> DRAWS_COLLISIONS) & 1u) + define("ROULETTE", plan.frame.roulette > 0) +
         define("SPHERE_REGION",
                (bits_used(s.placed, [](const PlacedGrid& p) { return p.region; }) >> REGION_SPHERE) & 1u) +
         define("LIGHT_GRID", plan.light_entries > 0) + define("IN_SCATTERINGS_USED", 1u << plan.frame.in_scattering) +
         define("PHASES_USED", bits_used(s.media, [](const MediumBody& m) { return m.phase; })) +
         define("SHAPES_USED", bits_used(s.shapes, [](const Shape& shape) { return shape.type; })) +
         define("TRIANGLES", !s.triangles.empty()) + define("TEXTURED", !s.textures.empty()) +
         define("SPECULAR", scene_is_specular(s)) +
         define("LIGHTS_CHOSEN", plan.frame.light_picks < plan.frame.light_count) +
         define("LIGHTS_USED", bits_used(s.lights, [](const Light& l) { return l.type; }));
}

}  // namespace

bool scene_is_specular(const FlatScene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const Material& m) { return m.reflection > 0 || m.refraction > 0; });
}

std::string kernel_options(const FlatScene& scene, const RenderPlan& plan, const DeviceInfo& device, int lanes,
                           bool generic) {
  return define("LANES", static_cast<unsigned>(lanes)) + define("BVH_WIDTH", static_cast<unsigned>(scene.bvh_width)) +
         define("FAST_FMA", device.fast_fma) +
         define("STORAGE", static_cast<unsigned>(scene.voxels.empty() ? STORAGE_F32 : plan.storage)) +
         define("OUTLINE", device.cpu) + (generic ? "" : scene_options(scene, plan));
}

}  // namespace brume
