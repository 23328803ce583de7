// Lights of the scene file, and surfaces that emit.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <vector>

#include "base/error.hpp"
#include "flat/flatten_parts.hpp"

namespace brume {

namespace {

constexpr std::size_t INSTANCE_LIGHTS_MAX = std::size_t(1) << 22;  // some 300 MB of them

// A light beyond FAR_AWAY gets a unit of length of its own, in which it is no more than FAR_AWAY away.
void light_place(const LightDesc& desc, const FlatScene& scene, Light& light) {
  const dvec3 position = scene.point(desc.position), size = glm::abs(position);
  light.exponent =
      std::max(0, static_cast<int>(std::ceil(std::log2(std::max({size.x, size.y, size.z, FAR_AWAY}) / FAR_AWAY))));
  const double length = std::exp2(light.exponent);
  light.position = packed(position / length);
  if (light.falloff == FALLOFF_INVERSE_SQUARE)
    light.intensity = packed(desc.intensity / (scene.unit * length) / (scene.unit * length));
}

float one_minus_cos(double degrees) {
  const double half = std::sin(glm::radians(0.5 * degrees));
  return static_cast<float>(2 * half * half);
}

Light light_flatten(const LightDesc& l, const FlatScene& scene) {
  Light light{};
  light.type = l.type;
  light.falloff = l.falloff;
  light.direction = packed(glm::normalize(l.direction));
  light.intensity = packed(l.intensity);
  if (l.type != LIGHT_DIRECTIONAL) light_place(l, scene, light);
  light.outer = one_minus_cos(l.angle);
  light.inner = one_minus_cos(l.angle * (1 - l.softness));
  return light;
}

// The middle and the area of a shape that emits; no area: it is no light.
struct Extent {
  dvec3 middle{0};
  double area = 0;
};

Extent box_extent(const Affine& unit_from_world) {
  const dmat4 world_from_unit = glm::inverse(matrix(unit_from_world));
  const dvec3 x(world_from_unit[0]), y(world_from_unit[1]), z(world_from_unit[2]);
  const double faces = glm::length(glm::cross(x, y)) + glm::length(glm::cross(y, z)) + glm::length(glm::cross(z, x));
  return {dvec3(world_from_unit * glm::dvec4(0.5, 0.5, 0.5, 1)), 2 * faces};
}

// data: shared/shape.h
Extent extent_of(const Shape& shape) {
  const float* d = shape.data;
  const dvec3 first(d[0], d[1], d[2]), second(d[3], d[4], d[5]), third(d[6], d[7], d[8]);
  switch (shape.type) {
    case SHAPE_SPHERE:
      return {first, 4 * M_PI * d[3] * d[3]};
    case SHAPE_CYLINDER:
      return {first + 0.5 * d[6] * second, 2 * M_PI * d[7] * (double(d[6]) + d[7])};
    case SHAPE_QUAD: {
      const dvec3 fourth(d[9], d[10], d[11]), along = glm::cross(fourth, second), across = glm::cross(second, third);
      const dvec3 u = along / glm::dot(third, along), v = across / glm::dot(fourth, across);
      return {first + 0.5 * (u + v), glm::length(glm::cross(u, v))};
    }
    case SHAPE_BOX: {
      Affine a;
      std::copy(d, d + 12, a.m);
      return box_extent(a);
    }
    default:
      return {};
  }
}

Extent extent_of(const Triangle& t, const dmat4& world_from_triangle = dmat4(1.0)) {
  const auto corner = [&](int i) { return transform_point(world_from_triangle, dvec3(t.p[i].x, t.p[i].y, t.p[i].z)); };
  const dvec3 a = corner(0), b = corner(1), c = corner(2);
  return {(a + b + c) / 3.0, 0.5 * glm::length(glm::cross(b - a, c - a))};
}

bool is_lit(const Packed3& emission) { return emission.x > 0 || emission.y > 0 || emission.z > 0; }

void source_add(int primitive, int instance, const Packed3& emission, const Extent& extent, FlatScene& scene) {
  Light light{};
  light.type = LIGHT_SURFACE;
  light.primitive = primitive;
  light.instance = instance;
  light.points = 1;
  light.intensity = emission;
  light.position = packed(extent.middle);
  light.outer = static_cast<float>(extent.area);
  scene.light_sources.push_back(light);
}

class Emitters {
 public:
  Emitters(const SceneDesc& desc, FlatScene& scene) : desc_(desc), scene_(scene) {}

  void shapes_add() {
    for (std::size_t i = 0; i < scene_.shapes.size(); ++i) {
      const Shape& shape = scene_.shapes[i];
      if (!lights_up(shape.material)) continue;
      const Extent extent = extent_of(shape);
      if (extent.area > 0) {
        source_add(static_cast<int>(i), INSTANCE_NONE, emission(shape.material), extent, scene_);
      } else {
        note_once(scene_.notes, "a plane or isosurface that emits is seen and lights nothing");
      }
    }
  }

  void triangles_add() {
    for (std::size_t i = 0; i < scene_.world_triangles(); ++i) {
      const Triangle& t = scene_.triangles[i];
      if (lights_up(t.material))
        source_add(FIRST_TRIANGLE + static_cast<int>(i), INSTANCE_NONE, emission(t.material), extent_of(t), scene_);
    }
  }

  void instances_add() {
    own_find();
    count_check();
    for (std::size_t k = 0; k < scene_.instances.size(); ++k) {
      const Instance& instance = scene_.instances[k];
      const FlatMesh& mesh = scene_.meshes[static_cast<std::size_t>(instance.mesh)];
      if (instance.material < 0) {
        for (const int i : own_[static_cast<std::size_t>(instance.mesh)]) instance_add(k, i);
      } else if (lights_up(instance.material)) {
        for (int i = mesh.first; i < mesh.first + mesh.count; ++i) instance_add(k, i);
      }
    }
  }

 private:
  bool lights_up(int material) const {
    const auto i = static_cast<std::size_t>(material);
    return is_lit(scene_.materials[i].emission) && (i >= desc_.materials.size() || desc_.materials[i].is_light);
  }
  const Packed3& emission(int material) const { return scene_.materials[static_cast<std::size_t>(material)].emission; }

  void own_find() {
    for (const FlatMesh& mesh : scene_.meshes) {
      own_.emplace_back();
      for (int i = mesh.first; i < mesh.first + mesh.count; ++i)
        if (lights_up(scene_.triangles[static_cast<std::size_t>(i)].material)) own_.back().push_back(i);
    }
  }

  // Each triangle of each instance is a light; so many that there is no room for them are refused.
  void count_check() const {
    std::size_t lights = 0;
    for (const Instance& instance : scene_.instances) {
      const auto m = static_cast<std::size_t>(instance.mesh);
      if (instance.material < 0) lights += own_[m].size();
      if (instance.material >= 0 && lights_up(instance.material))
        lights += static_cast<std::size_t>(scene_.meshes[m].count);
    }
    if (lights > INSTANCE_LIGHTS_MAX)
      throw InputError(desc_.file.string() + ": /shapes: " + std::to_string(lights) +
                       " triangles of instances emit, each of which is a light; at most " +
                       std::to_string(INSTANCE_LIGHTS_MAX) + " are allowed, a material with \"light\": false has none");
  }

  void instance_add(std::size_t instance, int triangle) {
    const Instance& at = scene_.instances[instance];
    const Triangle& t = scene_.triangles[static_cast<std::size_t>(triangle)];
    source_add(FIRST_TRIANGLE + triangle, static_cast<int>(instance),
               emission(at.material >= 0 ? at.material : t.material), extent_of(t, matrix(at.world_from_mesh)), scene_);
  }

  const SceneDesc& desc_;
  FlatScene& scene_;
  std::vector<std::vector<int>> own_;  // of each mesh with instances: triangles whose own material emits
};

}  // namespace

void flatten_lights(const SceneDesc& desc, FlatScene& scene) {
  for (const LightDesc& l : desc.lights) scene.light_sources.push_back(light_flatten(l, scene));
}

void flatten_emitters(const SceneDesc& desc, FlatScene& scene) {
  Emitters emitters(desc, scene);
  emitters.shapes_add();
  emitters.triangles_add();
  emitters.instances_add();
}

}  // namespace brume
