// Analytic shapes, which become Shape records. Meshes and triangles: load_meshes.cpp, flatten_meshes.cpp.
#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numeric>

#include "accel/bvh.hpp"
#include "flat/flatten_parts.hpp"

namespace brume {

namespace {

template <class... Values>
void put(Shape& shape, int at, const Values&... values) {
  const auto one = [&](const dvec3& v) {
    for (int i = 0; i < 3; ++i) shape.data[at++] = static_cast<float>(v[i]);
  };
  (one(values), ...);
}

// Analytic shapes into records (layout: shared/shape.h).
struct PackShape {
  const FlatScene& scene;
  Shape& out;
  int& isosurfaces;  // how many there were before

  void operator()(const SphereDesc& s) const {
    out.type = SHAPE_SPHERE;
    put(out, 0, scene.point(s.center));
    out.data[3] = static_cast<float>(s.radius / scene.unit);
  }
  void operator()(const CylinderDesc& c) const {
    const dvec3 axis = glm::normalize(c.top - c.base);
    out.type = SHAPE_CYLINDER;
    put(out, 0, scene.point(c.base), axis);
    out.data[6] = static_cast<float>(glm::length(c.top - c.base) / scene.unit);
    out.data[7] = static_cast<float>(c.radius / scene.unit);
    put(out, 8, tangent(axis));
  }
  void operator()(const PlaneDesc& p) const {
    const dvec3 normal = glm::normalize(p.normal);
    out.type = SHAPE_PLANE;
    put(out, 0, scene.point(p.point), normal, scene.unit * tangent(normal));
  }
  void operator()(const QuadDesc& q) const {
    out.type = SHAPE_QUAD;
    const dvec3 u = q.u / scene.unit, v = q.v / scene.unit, across = glm::cross(u, v);
    const double area = glm::dot(across, across);
    put(out, 0, scene.point(q.corner), glm::normalize(across), glm::cross(v, across) / area,
        glm::cross(across, u) / area);
  }
  void operator()(const BoxDesc& b) const {
    out.type = SHAPE_BOX;
    dmat4 world_from_unit(1.0);
    for (int i = 0; i < 3; ++i) {
      world_from_unit[i][i] = b.max[i] - b.min[i];
      world_from_unit[3][i] = b.min[i];
    }
    const Affine a = affine(glm::inverse(flat_from(scene, transform_matrix(b.transform) * world_from_unit)));
    std::copy(a.m, a.m + 12, out.data);
  }
  void operator()(const IsosurfaceDesc&) const {
    out.type = SHAPE_ISOSURFACE;
    out.data[0] = static_cast<float>(isosurfaces++);
  }
  void operator()(const TriangleDesc&) const {}
  void operator()(const MeshDesc&) const {}
};

// Of fewer, in nodes, each is tried: rays that go together try one in a fraction of what a node costs each of them.
constexpr std::size_t SHAPES_LISTED = 2;
constexpr double SHAPE_ROUNDING = 0x1p-20;  // of coordinates: a shape is met that far from where it is, at most

// Corners of everything finite.
struct AddBounds {
  Bounds& bounds;
  void box(const dvec3& lo, const dvec3& hi, const dmat4& m = dmat4(1.0)) const {
    for (int c = 0; c < 8; ++c)
      bounds.add(transform_point(m, dvec3(c & 1 ? hi.x : lo.x, c & 2 ? hi.y : lo.y, c & 4 ? hi.z : lo.z)));
  }
  void operator()(const SphereDesc& s) const { box(s.center - s.radius, s.center + s.radius); }
  void operator()(const CylinderDesc& c) const {
    box(c.base - c.radius, c.base + c.radius);
    box(c.top - c.radius, c.top + c.radius);
  }
  void operator()(const PlaneDesc&) const {}
  void operator()(const QuadDesc& q) const {
    for (int c = 0; c < 4; ++c) bounds.add(q.corner + double(c & 1) * q.u + double(c >> 1) * q.v);
  }
  void operator()(const BoxDesc& b) const { box(b.min, b.max, transform_matrix(b.transform)); }
  void operator()(const IsosurfaceDesc&) const {}  // added with its grid
  void operator()(const TriangleDesc&) const {}    // added with its vertices, as those of a mesh
  void operator()(const MeshDesc&) const {}
};

BvhBox shape_box(const FlatScene& scene, const Bounds& bounds) {
  const dvec3 lo = scene.point(bounds.lo), hi = scene.point(bounds.hi);
  const dvec3 size = glm::max(glm::abs(lo), glm::abs(hi));
  BvhBox box;
  for (int k = 0; k < 3; ++k) {
    box.lo[k] = static_cast<float>(lo[k] - SHAPE_ROUNDING * std::max({size.x, size.y, size.z}));
    box.hi[k] = static_cast<float>(hi[k] + SHAPE_ROUNDING * std::max({size.x, size.y, size.z}));
  }
  return box;
}

}  // namespace

void note_once(std::vector<std::string>& notes, const std::string& note) {
  if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
}

LoadedShapes load_shapes(const SceneDesc& desc, LoadedScene& loaded, std::vector<std::string>& notes) {
  LoadedShapes shapes;
  for (const ShapeDesc& shape : desc.shapes) {
    std::visit(AddBounds{shapes.bounds}, shape.geometry);
    if (std::holds_alternative<TriangleDesc>(shape.geometry) || std::holds_alternative<MeshDesc>(shape.geometry))
      continue;
    shapes.analytic.push_back(&shape);
    if (!std::holds_alternative<IsosurfaceDesc>(shape.geometry)) continue;
    shapes.isosurfaces.push_back(load_isosurface(desc, shape, loaded, notes));
    medium_bounds_add(shapes.isosurfaces.back().placed, shapes.bounds);
  }
  load_meshes(desc, loaded, shapes, notes);
  return shapes;
}

void flatten_shapes(const LoadedShapes& shapes, FlatScene& scene) {
  int isosurfaces = 0;
  for (const ShapeDesc* desc : shapes.analytic) {
    Shape shape{};
    std::visit(PackShape{scene, shape, isosurfaces}, desc->geometry);
    shape.material = desc->material >= 0 ? desc->material : shapes.default_material;
    scene.shapes.push_back(shape);
  }
}

void flatten_shape_bvh(const LoadedShapes& shapes, FlatScene& scene) {
  std::vector<BvhBox> boxes;
  std::vector<std::int32_t> names;
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    Bounds bounds;
    std::visit(AddBounds{bounds}, shapes.analytic[i]->geometry);
    const auto index = static_cast<std::int32_t>(i);
    if (bounds.empty()) {
      scene.shape_list.push_back(index);
    } else {
      boxes.push_back(shape_box(scene, bounds));
      names.push_back(index);
    }
  }
  if (boxes.size() < SHAPES_LISTED * static_cast<std::size_t>(scene.bvh_width) || scene.bvh_rule == BVH_LIST) {
    scene.shape_list.resize(scene.shapes.size());
    std::iota(scene.shape_list.begin(), scene.shape_list.end(), 0);
    return;
  }
  FlatBvh bvh{std::move(scene.bvh_nodes), std::move(scene.bvh_blocks)};
  scene.shape_root = bvh_append_boxes(bvh, boxes, scene.bvh_width, names);
  scene.bvh_nodes = std::move(bvh.nodes);
  scene.bvh_blocks = std::move(bvh.blocks);
}

}  // namespace brume
