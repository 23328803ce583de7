// One closed form: a scene of scenes/tests and the radiance that its derivation gives, held against kernels and
// reference.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "check/check_images.hpp"
#include "plan/planned_scene.hpp"
#include "reference/render.hpp"
#include "reference/sampling.hpp"
#include "render/renderer.hpp"
#include "scene/scene_reader.hpp"

namespace brume::test {

inline constexpr double KERNEL_LIMIT = 1e-5;      // relative, float
inline constexpr double REFERENCE_LIMIT = 1e-12;  // relative, double

// Radiance of a camera ray of the flat scene, by the derivation in the scene's file.
using ClosedForm = std::function<double(const PlannedScene&, const reference::RayD&)>;

// As JSON, so that no digit is lost.
inline std::string number(double v) {
  char digits[40];
  std::snprintf(digits, sizeof digits, "%.17g", v);
  return digits;
}

inline Context& pocl() {
  static Context context(device_choose("portable computing language"));
  return context;
}

inline PlannedScene scene_flat(const std::string& name, const std::vector<std::string>& overrides, int lanes) {
  const SceneDesc desc = scene_read(std::string(BRUME_SOURCE_DIR) + "/scenes/tests/" + name, overrides);
  return flatten(desc, {bvh_width_for(lanes), {}});
}

inline void expect_relative(double value, double expected, double limit, const std::string& where) {
  EXPECT_LE(std::abs(value - expected), limit * std::abs(expected))
      << where << ": " << value << " instead of " << expected;
}

// Closed forms are in the units of the scene's file.
inline reference::RayD in_world(const PlannedScene& scene, const reference::RayD& ray) {
  return {scene.world(ray.origin), ray.dir};
}

inline void expect_closed_form(const std::string& name, const ClosedForm& form,
                               const std::vector<std::string>& overrides = {}, int scatter_order = 0,
                               double reference_limit = REFERENCE_LIMIT) {
  const PlannedScene scene = scene_flat(name, overrides, 4);
  const reference::Context context(scene, {scatter_order, 1});
  const Camera& camera = scene.frame.camera;
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x) {
      const reference::RayD ray = reference::camera_ray(camera, x, y, {0.5, 0.5});
      expect_relative(reference::ray_render(context, ray).radiance.y, form(scene, in_world(scene, ray)),
                      reference_limit, name + ", reference, pixel " + std::to_string(x) + "," + std::to_string(y));
    }
  for (const int lanes : {1, 4, 8, 16}) {
    // Kernels made for the scene with 8 lanes; else those for any scene, which are built once for all tests.
    const PlannedScene flat = scene_flat(name, overrides, lanes);
    Film film({camera.width, camera.height});
    Renderer(pocl(), flat, {lanes, lanes != 8, 0}).render(film, [](double) { return true; });
    for (int y = 0; y < camera.height; ++y)
      for (int x = 0; x < camera.width; ++x) {
        const reference::RayD ray = reference::camera_ray(camera, x, y, {0.5, 0.5});
        expect_relative(
            film.pixels()[y * camera.width + x].radiance.y, form(scene, in_world(scene, ray)), KERNEL_LIMIT,
            name + ", " + std::to_string(lanes) + " lanes, pixel " + std::to_string(x) + "," + std::to_string(y));
      }
  }
}

}  // namespace brume::test
