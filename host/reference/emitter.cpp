// See emitter.hpp. Written from PICTURE.md: which place two numbers mean, and the solid angle that it stands for.
#include "reference/emitter.hpp"

#include <array>
#include <cmath>
#include <glm/matrix.hpp>

#include "reference/instances.hpp"
#include "reference/sampling.hpp"
#include "reference/surface.hpp"

namespace brume::reference {
namespace {

// A place, the normal there (of any length and side), and the area of all the places of which it is one.
struct Place {
  dvec3 point, normal;
  double area;
};

double solid_angle(const Place& place, const dvec3& from) {
  const dvec3 way = place.point - from;
  const double square = glm::dot(way, way);
  return square > 0 ? place.area * std::abs(glm::dot(vec_unit(place.normal), vec_unit(way))) / square : 0;
}

dvec3 data_vec(const Shape& shape, int i) { return {shape.data[i], shape.data[i + 1], shape.data[i + 2]}; }

Place quad_place(const Shape& shape, const dvec2& xi) {
  // the rows that give s and t, and the normal, are the inverse of the sides
  const glm::dmat3 sides =
      glm::inverse(glm::transpose(glm::dmat3(data_vec(shape, 6), data_vec(shape, 9), data_vec(shape, 3))));
  return {data_vec(shape, 0) + xi.x * sides[0] + xi.y * sides[1], data_vec(shape, 3),
          glm::length(glm::cross(sides[0], sides[1]))};
}

struct Seen {
  dvec3 point;
  double solid;
};

Seen sphere_seen(const Shape& shape, const dvec3& from, const dvec2& xi) {
  const dvec3 to = data_vec(shape, 0) - from;
  const double radius = shape.data[3], distance = glm::length(to), turn = 2 * M_PI * xi.y;
  if (distance <= radius) {
    const double z = 1 - 2 * xi.x, side = std::sqrt(1 - z * z);
    const dvec3 n(side * std::cos(turn), side * std::sin(turn), z);
    const Place place{data_vec(shape, 0) + radius * n, n, 4 * M_PI * radius * radius};
    return {place.point, solid_angle(place, from)};
  }
  const double widest = std::asin(radius / distance), wide = 2 * std::pow(std::sin(widest / 2), 2);
  const double angle = 2 * std::asin(std::sqrt(xi.x * wide / 2));
  const auto side = vec_beside(to / distance);
  const dvec3 dir =
      std::cos(angle) * to / distance + std::sin(angle) * (std::cos(turn) * side[0] + std::sin(turn) * side[1]);
  // by the sine rule: the angle at the place between the way and the radius
  const double across = distance * std::sin(angle);
  const double t = distance * std::cos(angle) - std::sqrt(std::max(radius * radius - across * across, 0.0));
  return {from + t * dir, 2 * M_PI * wide};
}

Place cylinder_place(const Shape& shape, const dvec3& from, const dvec2& xi) {
  const dvec3 axis = vec_unit(data_vec(shape, 3)), x = vec_unit(data_vec(shape, 8)), y = glm::cross(axis, x);
  const double height = shape.data[6], radius = shape.data[7];
  const dvec3 rel = from - data_vec(shape, 0), p(glm::dot(rel, x), glm::dot(rel, y), glm::dot(rel, axis));
  const double off = std::hypot(p.x, p.y);
  const bool within = off <= radius, inside = within && p.z >= 0 && p.z <= height;
  const double arc = inside ? M_PI : (within ? 0 : std::acos(radius / off)), cap = M_PI * radius * radius;
  const double side = 2 * arc * radius * height, bottom = inside || p.z < 0 ? cap : 0;
  const double top = inside || p.z > height ? cap : 0, area = side + bottom + top, at = xi.x * area;
  dvec3 q, n(0, 0, 1);
  if (at < side) {
    const double angle = std::atan2(p.y, p.x) + (2 * at / side - 1) * arc;
    n = {std::cos(angle), std::sin(angle), 0};
    q = {radius * n.x, radius * n.y, xi.y * height};
  } else {
    const bool above = at >= side + bottom;
    const double out = radius * std::sqrt((at - side - (above ? bottom : 0)) / cap), turn = 2 * M_PI * xi.y;
    q = {out * std::cos(turn), out * std::sin(turn), above ? height : 0};
  }
  const auto world = [&](const dvec3& v) { return v.x * x + v.y * y + v.z * axis; };
  return {data_vec(shape, 0) + world(q), world(n), area};
}

Place box_place(const Shape& shape, const dvec3& from, const dvec2& xi) {
  Affine unit_from_world;
  std::copy(shape.data, shape.data + 12, unit_from_world.m);
  const dvec3 p = affine_point(unit_from_world, from);
  const glm::dmat3 linear = glm::transpose(glm::dmat3(data_vec(shape, 0), data_vec(shape, 4), data_vec(shape, 8)));
  const glm::dmat3 edges = glm::inverse(linear);
  const dvec3 corner = from - edges * p;
  const bool inside = p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x <= 1 && p.y <= 1 && p.z <= 1;
  double total = 0;
  std::array<double, 6> area{};
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    const bool seen = inside || (face % 2 ? p[axis] > 1 : p[axis] < 0);
    if (seen) area[face] = glm::length(glm::cross(edges[(axis + 1) % 3], edges[(axis + 2) % 3]));
    total += area[face];
  }
  double left = xi.x * total;
  int face = 0;
  while (face < 5 && left >= area[face]) left -= area[face++];
  const int axis = face / 2, b = (axis + 1) % 3, c = (axis + 2) % 3;
  return {corner + double(face % 2) * edges[axis] + left / area[face] * edges[b] + xi.y * edges[c],
          glm::cross(edges[b], edges[c]), total};
}

Seen shape_seen(const Shape& shape, const dvec3& from, const dvec2& xi) {
  static_assert(SHAPE_ISOSURFACE == 5 && SHAPE_COUNT == 6, "shape_seen knows all that are lights");
  if (shape.type == SHAPE_SPHERE) return sphere_seen(shape, from, xi);
  const Place place = shape.type == SHAPE_CYLINDER ? cylinder_place(shape, from, xi)
                      : shape.type == SHAPE_BOX    ? box_place(shape, from, xi)
                                                   : quad_place(shape, xi);
  return {place.point, solid_angle(place, from)};
}

// The two numbers of a ray for a point of a light.
dvec2 choice_of(const Light& light, const RandomStream& random, const dvec2& middle) {
  if (light.points == 0) return middle;
  const RandomStream own = random.child(STREAM_LIGHT_PLACE);
  const uint index = own.sample * static_cast<uint>(light.points) + static_cast<uint>(light.point);
  return sobol_scrambled(index, own.pixel, primitive_name(light.primitive, light.instance), own.seed);
}

}  // namespace

LightSample emitter_at(const PlannedScene& scene, const Light& light, const dvec3& point, const RandomStream& random) {
  dvec3 radiance = vec_promote(light.intensity);
  Seen seen;
  if (light.primitive >= FIRST_TRIANGLE) {
    const TriangleD t = triangle_in_world(scene, light.primitive, light.instance);
    const dvec2 xi = choice_of(light, random, {4.0 / 9, 0.5});
    const std::array<dvec3, 3>& p = t.p;
    const std::array<double, 3> share{1 - std::sqrt(xi.x), std::sqrt(xi.x) * (1 - xi.y), std::sqrt(xi.x) * xi.y};
    const dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
    const Place place{share[0] * p[0] + share[1] * p[1] + share[2] * p[2], normal, glm::length(normal) / 2};
    dvec2 uv(0);
    for (int k = 0; k < 3; ++k) uv += share[k] * dvec2(t.uv[2 * k], t.uv[2 * k + 1]);
    const int texture = scene.materials[static_cast<std::size_t>(t.material)].emission_texture;
    if (texture >= 0) radiance *= texture_lookup(scene, texture, uv);
    seen = {place.point, solid_angle(place, point)};
  } else {
    const Shape& shape = scene.shapes[static_cast<std::size_t>(light.primitive)];
    seen = shape_seen(shape, point, choice_of(light, random, dvec2(shape.type == SHAPE_SPHERE ? 0 : 0.5)));
  }
  const double distance = glm::length(seen.point - point);
  if (distance == 0) return {};
  return {(point - seen.point) / distance, radiance * (seen.solid / std::max(light.points, 1)), distance,
          distance * (1 - 1.0 / 4096)};
}

}  // namespace brume::reference
