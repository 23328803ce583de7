// Camera, film size, background and lights.
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "flat/flatten_parts.hpp"

namespace brume {

void flatten_camera(const SceneDesc& desc, FlatScene& scene) {
  const CameraDesc& c = desc.camera;
  const dvec3 forward = glm::normalize(c.target - c.eye);
  const dvec3 right = glm::normalize(glm::cross(forward, c.up));
  const dvec3 up = glm::cross(right, forward);
  const double half = c.type == CAMERA_PERSPECTIVE ? std::tan(glm::radians(0.5 * c.vfov)) : 0.5 * c.height;
  const double aspect = double(desc.film.size.x) / desc.film.size.y;

  Frame& frame = scene.frame;
  frame.camera.type = c.type;
  frame.camera.eye = packed(c.eye - scene.origin);
  frame.camera.forward = packed(forward);
  frame.camera.right = packed(half * aspect * right);
  frame.camera.up = packed(half * up);
  frame.camera.width = desc.film.size.x;
  frame.camera.height = desc.film.size.y;
  frame.camera.spp = desc.film.spp;
  frame.background = packed(desc.background);
  frame.ambient = packed(desc.ambient);
  frame.in_scattering = desc.render.in_scattering;
  frame.roulette = static_cast<float>(desc.render.roulette);
  frame.max_depth = desc.render.max_depth;
  frame.seed = static_cast<uint>(desc.render.seed);
}

void flatten_lights(const SceneDesc& desc, FlatScene& scene) {
  for (const LightDesc& l : desc.lights) {
    Light light{};
    light.type = l.type;
    light.falloff = l.falloff;
    light.position = packed(l.position - scene.origin);
    light.direction = packed(glm::normalize(l.direction));
    light.intensity = packed(l.intensity);
    light.cos_outer = static_cast<float>(std::cos(glm::radians(l.angle)));
    light.cos_inner = static_cast<float>(std::cos(glm::radians(l.angle * (1 - l.softness))));
    scene.lights.push_back(light);
  }
  scene.frame.light_count = static_cast<int>(scene.lights.size());
}

}  // namespace brume
