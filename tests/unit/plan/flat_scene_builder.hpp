// Flat scenes made by hand for tests, with numbers that float holds exactly. Not the flattening of scene files.
#pragma once
#include <cmath>
#include <functional>
#include <glm/vec3.hpp>

#include "plan/render_plan.hpp"
#include "shared/method.h"
#include "shared/phase.h"

namespace brume::test {

inline Packed3 packed(double x, double y, double z) {
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}
inline Packed3 packed(const glm::dvec3& v) { return packed(v.x, v.y, v.z); }
inline Packed3 grey(double v) { return packed(v, v, v); }

inline Affine affine_scale(double s, const glm::dvec3& offset = glm::dvec3(0)) {
  const float f = static_cast<float>(s);
  const Packed3 o = packed(offset);
  return {{f, 0, 0, o.x, 0, f, 0, o.y, 0, 0, f, o.z}};
}

// An orthographic camera on the +z side that looks down -z at the square [-1,1]² through size x size pixels.
inline PlannedScene scene_empty(int size = 1) {
  PlannedScene scene;
  Camera& camera = scene.frame.camera;
  camera = {packed(0, 0, 8), CAMERA_ORTHOGRAPHIC, packed(0, 0, -1), size, packed(1, 0, 0), size, packed(0, 1, 0), 1, 0};
  scene.frame.crop_x1 = scene.frame.crop_y1 = size;
  scene.frame.takes_ends = 1;
  return scene;
}

inline Material& material_add(PlannedScene& scene, double diffuse = 1) {
  Material material{};
  material.diffuse = grey(diffuse);
  material.texture = material.emission_texture = -1;
  scene.materials.push_back(material);
  return scene.materials.back();
}

// Shapes take material 0, which is made when there is none.
inline void shape_add(PlannedScene& scene, int type, std::initializer_list<double> data) {
  if (scene.materials.empty()) material_add(scene);
  Shape shape{};
  shape.type = type;
  int i = 0;
  for (const double x : data) shape.data[i++] = static_cast<float>(x);
  scene.shape_list.push_back(static_cast<int>(scene.shapes.size()));
  scene.shapes.push_back(shape);
}

inline Triangle& triangle_add(PlannedScene& scene, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  if (scene.materials.empty()) material_add(scene);
  Triangle triangle{};
  triangle.p[0] = packed(a);
  triangle.p[1] = packed(b);
  triangle.p[2] = packed(c);
  triangle.shading = TRIANGLE_FLAT;
  scene.triangles.push_back(triangle);
  return scene.triangles.back();
}

inline void light_add_directional(PlannedScene& scene, const glm::dvec3& direction, double irradiance) {
  Light light{};
  light.type = LIGHT_DIRECTIONAL;
  light.direction = packed(direction);
  light.intensity = grey(irradiance);
  scene.lights.push_back(light);
}

inline Light& light_add_point(PlannedScene& scene, const glm::dvec3& position, double intensity) {
  Light light{};
  light.type = LIGHT_POINT;
  light.falloff = FALLOFF_INVERSE_SQUARE;
  light.position = packed(position);
  light.intensity = grey(intensity);
  scene.lights.push_back(light);
  return scene.lights.back();
}

// The rows of a medium in a flat scene, until another is added.
struct MediumRows {
  PlacedGrid& placed;
  MediumBody& body;
  MediumWalk& walk;
};

// A medium of constant density over [lo, hi] in cell space, which is world space.
inline MediumRows medium_add_constant(PlannedScene& scene, const glm::dvec3& lo, const glm::dvec3& hi, double sigma_a,
                                      double sigma_s, double density = 1) {
  PlacedGrid placed{};
  placed.cell_from_world = affine_scale(1);
  placed.lo = packed(lo);
  placed.hi = packed(hi);
  placed.region = REGION_BOX;
  placed.constant_density = static_cast<float>(density);
  placed.grid = -1;
  MediumBody body{};
  body.density = static_cast<int>(scene.placed.size());
  body.glow = body.liquid = -1;
  body.sigma_a = grey(sigma_a);
  body.sigma_s = grey(sigma_s);
  body.phase = PHASE_ISOTROPIC;
  scene.placed.push_back(placed);
  scene.media.push_back(body);
  scene.walks.push_back({METHOD_HOMOGENEOUS, 0.25f, 0.1f, 0, -1, 0, 0, 0, 0, 0, 0});
  return {scene.placed.back(), scene.media.back(), scene.walks.back()};
}

// A grid of cells over [0, cells], cell space being world space. density(sample) is asked for every sample of every
// brick; a brick of zeros is left out, as in a flat scene.
inline MediumRows medium_add_grid(PlannedScene& scene, const glm::ivec3& cells, int interpolation,
                                  const std::function<double(glm::ivec3)>& density, double sigma_a, double sigma_s) {
  const MediumRows medium = medium_add_constant(scene, glm::dvec3(0), glm::dvec3(cells), sigma_a, sigma_s);
  medium.placed.interpolation = interpolation;
  medium.placed.grid = static_cast<int>(scene.grids.size());
  medium.walk.method = interpolation == INTERPOLATION_NEAREST ? METHOD_DDA_NEAREST : METHOD_DDA_GAUSS2;
  const glm::ivec3 n = (cells + BRICK_CELLS - 1) / BRICK_CELLS;
  scene.grids.push_back({static_cast<int>(scene.bricks.size()), cells.x, cells.y, cells.z, n.x, n.y, n.z});
  const glm::ivec3 blocks = (n + 7) / 8;
  const auto index = scene.bricks.size();
  scene.bricks.resize(index + static_cast<std::size_t>(blocks.x * blocks.y * blocks.z), 0);
  for (std::size_t block = index, end = scene.bricks.size(); block < end; ++block) {
    scene.bricks[block] = static_cast<int>(scene.bricks.size());
    scene.bricks.resize(scene.bricks.size() + 512, BRICK_EMPTY);
  }
  for (int b = 0; b < n.x * n.y * n.z; ++b) {
    const glm::ivec3 brick(b % n.x, b / n.x % n.y, b / (n.x * n.y)), first = brick * BRICK_CELLS;
    const glm::ivec3 block = brick / 8, in = brick % 8;
    std::vector<float> samples;
    bool empty = true;
    for (int i = 0; i < BRICK_VALUES; ++i) {
      const glm::ivec3 s(i % BRICK_SAMPLES, i / BRICK_SAMPLES % BRICK_SAMPLES, i / (BRICK_SAMPLES * BRICK_SAMPLES));
      samples.push_back(static_cast<float>(density(first + s)));
      empty = empty && samples.back() == 0;
    }
    if (empty) continue;
    const int begin =
        scene.bricks[index + static_cast<std::size_t>((block.z * blocks.y + block.y) * blocks.x + block.x)];
    scene.bricks[static_cast<std::size_t>(begin) + static_cast<std::size_t>((in.z * 8 + in.y) * 8) +
                 static_cast<std::size_t>(in.x)] = static_cast<int>(scene.voxels.size() / BRICK_VALUES);
    scene.voxels.insert(scene.voxels.end(), samples.begin(), samples.end());
    const auto [min, max] = std::minmax_element(samples.begin(), samples.end());
    scene.brick_ranges.insert(scene.brick_ranges.end(), {*min, *max});
  }
  return medium;
}

}  // namespace brume::test
