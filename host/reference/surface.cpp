// Normals, texture coordinates and reflection: see the header, kernels/shared/shape.h and kernels/shared/material.h.
#include "reference/surface.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <optional>

#include "reference/instances.hpp"
#include "reference/isosurface.hpp"

namespace brume::reference {
namespace {

struct Geometry {
  dvec3 geometric_normal, normal;
  dvec2 uv;
};
Geometry flat_geometry(const dvec3& normal, const dvec2& uv) { return {normal, normal, uv}; }

double turns(double y, double x) {  // azimuth in [0,1)
  const double turn = std::atan2(y, x) / (2 * PI);
  return turn - std::floor(turn);
}

Geometry sphere_geometry(const float* data, const dvec3& point) {
  const dvec3 normal = vec_unit(point - vec_promote(data));
  return flat_geometry(normal, {turns(-normal.z, normal.x), 1 - std::acos(std::clamp(normal.y, -1.0, 1.0)) / PI});
}

Geometry cylinder_geometry(const float* data, const dvec3& point) {
  const dvec3 axis = vec_unit(vec_promote(data + 3)), x_axis = vec_unit(vec_promote(data + 8));
  const double height = data[6], radius = data[7];
  const dvec3 from_base = point - vec_promote(data);
  const double z = glm::dot(from_base, axis);
  const double x = glm::dot(from_base, x_axis), y = glm::dot(from_base, glm::cross(axis, x_axis));
  // side or cap: the one from which the point is less far
  const double off_side = std::abs(std::hypot(x, y) - radius);
  const double off_base = std::abs(z), off_top = std::abs(z - height);
  if (off_side < std::min(off_base, off_top))
    return flat_geometry(vec_unit(from_base - z * axis), {turns(y, x), z / height});
  return flat_geometry(off_top < off_base ? axis : -axis, {(x / radius + 1) / 2, (y / radius + 1) / 2});
}

Geometry plane_geometry(const float* data, const dvec3& point) {
  const dvec3 normal = vec_unit(vec_promote(data + 3)), u_axis = vec_promote(data + 6);
  const dvec3 p = point - vec_promote(data);
  return flat_geometry(normal, {glm::dot(p, u_axis), glm::dot(p, glm::cross(normal, u_axis))});
}

Geometry quad_geometry(const float* data, const dvec3& point) {
  const dvec3 p = point - vec_promote(data);
  return flat_geometry(vec_unit(vec_promote(data + 3)),
                       {glm::dot(p, vec_promote(data + 6)), glm::dot(p, vec_promote(data + 9))});
}

Geometry box_geometry(const float* data, const dvec3& point) {
  Affine unit_from_world;
  std::copy(data, data + 12, unit_from_world.m);
  const dvec3 p = affine_point(unit_from_world, point);
  int face = 0;  // the axis whose face is nearest
  const auto distance = [&](int axis) { return std::min(std::abs(p[axis]), std::abs(p[axis] - 1)); };
  for (int axis = 1; axis < 3; ++axis)
    if (distance(axis) < distance(face)) face = axis;
  const dvec3 outward = vec_promote(unit_from_world.m + 4 * face) * (p[face] > 0.5 ? 1.0 : -1.0);
  const dvec2 uv = face == 0 ? dvec2(p.y, p.z) : face == 1 ? dvec2(p.x, p.z) : dvec2(p.x, p.y);
  return flat_geometry(vec_unit(outward), uv);
}

using ShapeGeometry = Geometry (*)(const float* data, const dvec3& point);
constexpr ShapeGeometry SHAPE_GEOMETRIES[] = {sphere_geometry, cylinder_geometry, plane_geometry, quad_geometry,
                                              box_geometry};
static_assert(std::size(SHAPE_GEOMETRIES) == SHAPE_ISOSURFACE && SHAPE_ISOSURFACE + 1 == SHAPE_COUNT,
              "one row per closed form, in the order of ShapeType");

Geometry triangle_geometry(const TriangleD& triangle, double u, double v) {
  const double w = 1 - u - v;
  const dvec3 geometric = triangle.geometric_normal;
  const dvec3 smooth = w * triangle.n[0] + u * triangle.n[1] + v * triangle.n[2];
  const float* uv = triangle.uv;
  return {geometric, triangle.shading == TRIANGLE_FLAT ? geometric : vec_unit(smooth),
          w * dvec2(uv[0], uv[1]) + u * dvec2(uv[2], uv[3]) + v * dvec2(uv[4], uv[5])};
}

// Where in the image a surface's coordinates lie.
dvec2 image_point(const Texture& texture, const dvec2& uv) {
  return {texture.uv_scale[0] * uv.x + texture.uv_offset[0], texture.uv_scale[1] * uv.y + texture.uv_offset[1]};
}

// Beside an image that is shown once.
bool image_misses(const Texture& texture, const dvec2& uv) {
  const dvec2 p = image_point(texture, uv);
  return texture.wrap == WRAP_ONCE && (p.x < 0 || p.x > 1 || p.y < 0 || p.y > 1);
}

// The texel that stands for the i-th of an endless row of images.
double texel_wrapped(double i, double n, int wrap) {
  if (wrap == WRAP_CLAMP || wrap == WRAP_ONCE) return std::clamp(i, 0.0, n - 1);
  const double period = wrap == WRAP_MIRROR ? 2 * n : n, m = i - period * std::floor(i / period);
  return m < n ? m : 2 * n - 1 - m;
}

dvec3 image_lookup(const PlannedScene& scene, const Texture& texture, const dvec2& at) {
  if (image_misses(texture, at)) return dvec3(1);
  const dvec2 size(texture.width, texture.height);
  const dvec2 p = image_point(texture, at) * size - 0.5, base(std::floor(p.x), std::floor(p.y)), blend = p - base;
  const auto texel = [&](double dx, double dy) {
    const auto x = static_cast<std::size_t>(texel_wrapped(base.x + dx, size.x, texture.wrap));
    const auto row = static_cast<std::size_t>(texel_wrapped(base.y + dy, size.y, texture.wrap));
    return vec_promote(&scene.texels[3 * (texture.offset + row * static_cast<std::size_t>(texture.width) + x)]);
  };
  const dvec3 lower = (1 - blend.x) * texel(0, 0) + blend.x * texel(1, 0);
  const dvec3 upper = (1 - blend.x) * texel(0, 1) + blend.x * texel(1, 1);
  const dvec3 color = (1 - blend.y) * lower + blend.y * upper;
  return glm::max(static_cast<double>(texture.base) + static_cast<double>(texture.gain) * color, dvec3(0));
}

static_assert(MATERIAL_COUNT == 3 && TEXTURE_COUNT == 2, "what is below knows every model and texture");

// What the specular lobe raises to the shininess.
double lobe_base(int model, const dvec3& normal, const dvec3& to_light, const dvec3& to_viewer) {
  if (model == MATERIAL_PHONG)
    return std::max(0.0, glm::dot(2 * glm::dot(normal, to_light) * normal - to_light, to_viewer));
  const dvec3 half = to_light + to_viewer;
  const double length = glm::length(half);
  return length > 0 ? std::max(0.0, glm::dot(normal, half) / length) : 0;
}

// Of rays that leave a point where one with that hit ends.
double epsilon_of(const PlannedScene& scene, const dvec3& point, const HitD& hit) {
  const dvec3 size = glm::abs(point);
  const double reach =
      hit.instance == INSTANCE_NONE ? 0.0 : scene.instances[static_cast<std::size_t>(hit.instance)].reach;
  return 0x1p-17 * std::max({size.x, size.y, size.z, hit.t, reach});
}

}  // namespace

SurfaceD surface_at(const PlannedScene& scene, const RayD& ray, const HitD& hit) {
  SurfaceD surface;
  surface.point = ray.at(hit.t);
  Geometry geometry;
  std::optional<bool> leaves;  // where the hit itself says so
  if (hit.primitive >= FIRST_TRIANGLE) {
    const TriangleD triangle = triangle_in_world(scene, hit.primitive, hit.instance);
    geometry = triangle_geometry(triangle, hit.u, hit.v);
    surface.material = triangle.material;
  } else {
    const Shape& shape = scene.shapes[static_cast<std::size_t>(hit.primitive)];
    surface.material = shape.material;
    if (shape.type == SHAPE_ISOSURFACE) {
      const Normals normals = isosurface_normals(scene, scene.isosurfaces[static_cast<std::size_t>(shape.data[0])],
                                                 surface.point, ray.dir, hit);
      geometry = {normals.geometric, normals.shading, dvec2(0)};
      leaves = hit.v > 0;
    } else {
      geometry = SHAPE_GEOMETRIES[shape.type](shape.data, surface.point);
    }
  }
  surface.leaving = leaves.value_or(glm::dot(geometry.geometric_normal, ray.dir) > 0);
  const double side = surface.leaving ? -1 : 1;
  surface.geometric_normal = side * geometry.geometric_normal;
  surface.normal = side * geometry.normal;
  surface.uv = geometry.uv;

  const Material& material = scene.materials[static_cast<std::size_t>(surface.material)];
  surface.diffuse = vec_promote(material.diffuse);
  if (material.texture >= 0) {
    surface.diffuse *= texture_lookup(scene, material.texture, surface.uv);
    surface.second = texture_second(scene.textures[static_cast<std::size_t>(material.texture)], surface.uv);
  }
  surface.emission = vec_promote(material.emission);
  if (material.emission_texture >= 0) {
    surface.emission *= texture_lookup(scene, material.emission_texture, surface.uv);
    surface.second |= texture_second(scene.textures[static_cast<std::size_t>(material.emission_texture)], surface.uv);
  }
  surface.ray_epsilon = epsilon_of(scene, surface.point, hit);
  return surface;
}

std::vector<CornerD> surface_corners(const PlannedScene& scene, const SurfaceD& surface, const HitD& hit) {
  if (hit.primitive < FIRST_TRIANGLE) return {{surface, 1}};
  const TriangleD triangle = triangle_in_world(scene, hit.primitive, hit.instance);
  if (triangle.shading != TRIANGLE_GOURAUD) return {{surface, 1}};
  const double shares[3] = {1 - hit.u - hit.v, hit.u, hit.v};
  std::vector<CornerD> corners;
  for (int k = 0; k < 3; ++k) {
    corners.push_back({surface, shares[k]});
    SurfaceD& corner = corners.back().surface;
    corner.point = triangle.p[k];
    corner.normal = (surface.leaving ? -1.0 : 1.0) * triangle.n[k];
    corner.ray_epsilon = epsilon_of(scene, corner.point, hit);
  }
  return corners;
}

dvec3 surface_leave(const SurfaceD& surface, const dvec3& dir) {
  const double side = glm::dot(surface.geometric_normal, dir) < 0 ? -1 : 1;
  return surface.point + side * surface.ray_epsilon * surface.geometric_normal;
}

int texture_second(const Texture& texture, const dvec2& uv) {
  if (texture.type == TEXTURE_IMAGE) return image_misses(texture, uv) ? 1 : 0;
  const double scale = texture.scale;
  const double squares = std::floor(uv.x * scale) + std::floor(uv.y * scale);
  return std::fmod(squares, 2.0) != 0 ? 1 : 0;
}

dvec3 texture_lookup(const PlannedScene& scene, int texture_index, const dvec2& uv) {
  const Texture& texture = scene.textures[static_cast<std::size_t>(texture_index)];
  if (texture.type == TEXTURE_IMAGE) return image_lookup(scene, texture, uv);
  return vec_promote(texture_second(texture, uv) ? texture.color_b : texture.color_a);
}

dvec3 surface_reflect(const PlannedScene& scene, const SurfaceD& surface, const dvec3& view_dir, const dvec3& travel) {
  const double cosine = glm::dot(surface.normal, -travel);
  if (!(cosine > 0)) return dvec3(0);
  const Material& material = scene.materials[static_cast<std::size_t>(surface.material)];
  const dvec3 diffuse = surface.diffuse * (cosine / PI);
  if (material.model == MATERIAL_LAMBERT) return diffuse;
  const double base = lobe_base(material.model, surface.normal, -travel, -view_dir);
  return diffuse + vec_promote(material.specular) * std::pow(base, static_cast<double>(material.shininess));
}

}  // namespace brume::reference
