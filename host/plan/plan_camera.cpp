// Camera, film size and background.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>

#include "flat/transform.hpp"
#include "plan/plan_parts.hpp"

namespace brume {

namespace {

constexpr double BOUNDS_MARGIN = 1.0 / 32;  // flat units: camera rays start that much before the scene

// The place of the camera (shared/camera.h), as multiples of `forward` from the target, which is exact where the scene
// is.
void camera_place(const CameraDesc& c, const Bounds& bounds, const dvec3& forward, const FlatScene& scene,
                  Camera& camera) {
  const dvec3 eye = scene.point(c.eye), target = scene.point(c.target);
  const double distance = glm::distance(c.eye, c.target) / scene.unit;
  double along = -distance;
  if (!bounds.empty() && c.type == CAMERA_ORTHOGRAPHIC) {
    double nearest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 8; ++i) nearest = std::min(nearest, glm::dot(bounds.corner(i) - target, forward));
    along = std::max(along, nearest);
  } else if (!bounds.empty() && glm::distance(eye, bounds.center()) > FAR_AWAY) {
    along = std::max(along, glm::dot(bounds.center() - target, forward));
  }
  camera.axis = packed(along > -distance ? target + along * forward : eye);
  camera.back = static_cast<float>(distance + along);
}

Bounds flat_bounds(const Bounds& world, const FlatScene& scene) {
  Bounds flat;
  if (world.empty()) return flat;
  flat.add(scene.point(world.lo) - BOUNDS_MARGIN);
  flat.add(scene.point(world.hi) + BOUNDS_MARGIN);
  return flat;
}

// Whether camera rays may begin inside of a shape that refracts: those that begin at the bounds lie outside of all but
// planes.
bool starts_inside(const CameraDesc& camera, const FlatScene& scene) {
  const auto refracts = [&](const Shape& shape) {
    return scene.materials[static_cast<std::size_t>(shape.material)].refraction > 0;
  };
  const bool any = std::any_of(scene.materials.begin(), scene.materials.end(),
                               [](const Material& material) { return material.refraction > 0; });
  const bool within = !scene.bounds.empty() && glm::all(glm::greaterThanEqual(camera.eye, scene.bounds.lo)) &&
                      glm::all(glm::lessThanEqual(camera.eye, scene.bounds.hi));
  return any && (within || camera.type == CAMERA_ORTHOGRAPHIC ||
                 std::any_of(scene.shapes.begin(), scene.shapes.end(),
                             [&](const Shape& shape) { return shape.type == SHAPE_PLANE && refracts(shape); }));
}

}  // namespace

void plan_camera(const SceneDesc& desc, const FlatScene& scene, Frame& frame) {
  const CameraDesc& c = desc.camera;
  const dvec3 forward = glm::normalize(c.target - c.eye);
  const dvec3 right = glm::normalize(glm::cross(forward, c.up));
  const dvec3 up = glm::cross(right, forward);
  const double half = c.type == CAMERA_PERSPECTIVE ? std::tan(glm::radians(0.5 * c.vfov)) : 0.5 * c.height / scene.unit;
  const double aspect = double(desc.film.size.x) / desc.film.size.y;

  frame.camera.type = c.type;
  const Bounds bounds = flat_bounds(scene.bounds, scene);
  if (!bounds.empty()) {
    frame.bounds_lo = packed(bounds.lo);
    frame.bounds_hi = packed(bounds.hi);
  }
  camera_place(c, bounds, forward, scene, frame.camera);
  frame.camera.forward = packed(forward);
  frame.camera.right = packed(half * aspect * right);
  frame.camera.up = packed(half * up);
  frame.camera.width = desc.film.size.x;
  frame.camera.height = desc.film.size.y;
  frame.camera.spp = desc.film.spp;
  frame.background = packed(desc.background);
  frame.ambient = packed(desc.ambient);
  frame.roulette = static_cast<float>(desc.render.roulette);
  frame.max_depth = desc.render.max_depth;
  if (desc.render.integrator == INTEGRATOR_AMBIENT_OCCLUSION) {
    frame.max_depth = 0;
    frame.directions = desc.render.directions;
    frame.occlusion_rotates = desc.render.rotate;
    frame.occlusion_reach =
        static_cast<float>(desc.render.distance.value_or(std::numeric_limits<double>::infinity()) / scene.unit);
  }
  frame.cutoff = static_cast<float>(desc.render.cutoff);
  frame.starts_inside = starts_inside(c, scene);
  const bool water = std::any_of(desc.media.begin(), desc.media.end(),
                                 [](const MediumDesc& m) { return is_liquid(m, LIQUID_SURFACE); });
  frame.clear_shadows = desc.render.shadow_of_glass.value_or(water ? GLASS_CLEAR : GLASS_OPAQUE) == GLASS_CLEAR;
  frame.seed = static_cast<uint>(desc.render.seed);
}

}  // namespace brume
