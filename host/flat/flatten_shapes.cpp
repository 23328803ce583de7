// Shapes: analytic ones become Shape records, triangles and meshes become Triangles in world space behind a BVH.
#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "accel/bvh.hpp"
#include "base/error.hpp"
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
  void operator()(const TriangleDesc& t) const {
    for (const dvec3& p : t.vertices) bounds.add(p);
  }
  void operator()(const MeshDesc&) const {}  // added with its vertices
};

Mesh mesh_of(const TriangleDesc& t) {
  Mesh mesh;
  mesh.positions.assign(t.vertices.begin(), t.vertices.end());
  mesh.uvs = {{0, 0}, {1, 0}, {0, 1}};
  mesh.triangles.push_back({{0, 1, 2}, {-1, -1, -1}, {0, 1, 2}, -1});
  return mesh;
}

// A mesh in the world.
Mesh mesh_load(const MeshDesc& desc, LoadedScene& loaded, std::vector<std::string>& notes) {
  Mesh mesh = *loaded.mesh(desc.file);
  for (const std::string& note : mesh.notes) note_once(notes, note);  // of a mesh that several shapes show
  if (desc.shading != MeshShading::FLAT) mesh_complete_normals(mesh, desc.crease);
  const dmat4 m = transform_matrix(desc.transform);
  const glm::dmat3 normal_matrix = glm::transpose(glm::inverse(glm::dmat3(m)));
  for (dvec3& p : mesh.positions) p = transform_point(m, p);
  for (dvec3& n : mesh.normals) n = glm::length(n) > 0 ? glm::normalize(normal_matrix * n) : n;
  return mesh;
}

int shading_of(const ShapeDesc& shape) {
  const auto* mesh = std::get_if<MeshDesc>(&shape.geometry);
  if (!mesh || mesh->shading == MeshShading::FLAT) return TRIANGLE_FLAT;
  return mesh->shading == MeshShading::PHONG ? TRIANGLE_PHONG : TRIANGLE_GOURAUD;
}

Triangle triangle_flatten(const Mesh& mesh, const MeshTriangle& t, int shading, int material, const FlatScene& scene) {
  Triangle out{};
  out.material = material;
  out.shading = shading;
  for (int k = 0; k < 3; ++k) {
    out.p[k] = packed(scene.point(mesh.positions[t.position[k]]));
    if (shading != TRIANGLE_FLAT) out.n[k] = packed(mesh.normals[t.normal[k]]);
    if (t.uv[k] < 0) continue;
    out.uv[2 * k] = static_cast<float>(mesh.uvs[t.uv[k]].x);
    out.uv[2 * k + 1] = static_cast<float>(mesh.uvs[t.uv[k]].y);
  }
  return out;
}

// In float a far or tiny triangle may lose its area; it can then not be hit and has no normal.
bool has_area(const Triangle& t) {
  const auto vec = [](const Packed3& p) { return dvec3(p.x, p.y, p.z); };
  return glm::length(glm::cross(vec(t.p[1]) - vec(t.p[0]), vec(t.p[2]) - vec(t.p[0]))) > 0;
}

}  // namespace

void note_once(std::vector<std::string>& notes, const std::string& note) {
  if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
}

LoadedShapes load_shapes(const SceneDesc& desc, LoadedScene& loaded, std::vector<std::string>& notes) {
  LoadedShapes shapes;
  for (const ShapeDesc& shape : desc.shapes) {
    std::visit(AddBounds{shapes.bounds}, shape.geometry);
    if (const auto* triangle = std::get_if<TriangleDesc>(&shape.geometry)) {
      shapes.meshes.push_back({&shape, mesh_of(*triangle)});
    } else if (const auto* mesh = std::get_if<MeshDesc>(&shape.geometry)) {
      shapes.meshes.push_back({&shape, mesh_load(*mesh, loaded, notes)});
      for (const dvec3& p : shapes.meshes.back().mesh.positions) shapes.bounds.add(p);
    } else {
      shapes.analytic.push_back(&shape);
      if (!std::holds_alternative<IsosurfaceDesc>(shape.geometry)) continue;
      shapes.isosurfaces.push_back(load_isosurface(desc, shape, loaded, notes));
      medium_bounds_add(shapes.isosurfaces.back().placed, shapes.bounds);
    }
  }
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
  std::size_t dropped = 0;
  for (std::size_t i = 0; i < shapes.meshes.size(); ++i) {
    const auto& [desc, mesh] = shapes.meshes[i];
    for (const MeshTriangle& t : mesh.triangles) {
      const int own = t.material >= 0 ? shapes.first_material[i] + t.material : shapes.default_material;
      const Triangle flat =
          triangle_flatten(mesh, t, shading_of(*desc), desc->material >= 0 ? desc->material : own, scene);
      if (has_area(flat)) {
        scene.triangles.push_back(flat);
      } else {
        ++dropped;
      }
    }
  }
  if (dropped > 0)
    scene.notes.push_back(std::to_string(dropped) + " triangles have no area in single precision and are left out");
  FlatBvh bvh = bvh_build(scene.triangles, scene.bvh_width, scene.bvh_rule);
  scene.bvh_nodes = std::move(bvh.nodes);
  scene.bvh_blocks = std::move(bvh.blocks);
}

}  // namespace brume
