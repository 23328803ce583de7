// Triangles into the flat scene and behind a BVH: those in the world behind one, each mesh with instances behind one of
// its own, and the instances behind one over all their boxes.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "accel/bvh.hpp"
#include "flat/flatten_parts.hpp"

namespace brume {

namespace {

constexpr double BOX_ROUNDING = 0x1p-21;  // of coordinates: a ray is that much off in the space of a mesh, at most
constexpr double REACH_SHARE =
    1.0 / 16;  // of what rounding comes to, which is few units of 2^-24, in epsilons of 2^-17

// A space of its own, in which positions are single precision.
struct Space {
  dvec3 origin;
  double unit;
  dvec3 point(const dvec3& p) const { return (p - origin) / unit; }
  dmat4 from() const {  // to where it lies in
    dmat4 m(unit);
    m[3] = glm::dvec4(origin, 1);
    return m;
  }
};

// About the middle of a mesh, 1 to 2 units from there to its sides.
Space space_of(const LoadedMesh& mesh) {
  Bounds bounds;
  for (std::size_t i = mesh.first; i < mesh.first + mesh.count; ++i)
    for (const int p : mesh.mesh->triangles[i].position) bounds.add(mesh.mesh->positions[std::size_t(p)]);
  return {bounds.center(), std::exp2(std::floor(std::log2(bounds.longest_side())) - 1)};
}

Triangle triangle_flatten(const Mesh& mesh, const MeshTriangle& t, int shading, int material, const Space& space) {
  Triangle out{};
  out.material = material;
  out.shading = shading;
  for (int k = 0; k < 3; ++k) {
    out.p[k] = packed(space.point(mesh.positions[t.position[k]]));
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

double largest(const dvec3& v) { return std::max({v.x, v.y, v.z}); }

bool is_finite(const Affine& a) {
  return std::all_of(a.m, a.m + 12, [](float x) { return std::isfinite(x); });
}

// How large the terms get of which a point of the world, none of its coordinates larger than `size`, is made on its way
// to a space and back.
double round_trip(const dmat4& there, const dmat4& back, const dvec3& size) {
  const auto sizes = [](const dmat4& m) {
    return glm::dmat3(glm::abs(dvec3(m[0])), glm::abs(dvec3(m[1])), glm::abs(dvec3(m[2])));
  };
  return largest(sizes(back) * (sizes(there) * size + glm::abs(dvec3(there[3]))));
}

class MeshFlattener {
 public:
  MeshFlattener(const LoadedShapes& shapes, FlatScene& scene) : shapes_(shapes), scene_(scene) {
    const Bounds& b = scene.bounds;
    if (!b.empty()) scene_size_ = glm::max(glm::abs(scene.point(b.lo)), glm::abs(scene.point(b.hi)));
  }

  void run() {
    const Space world{scene_.origin, scene_.unit};
    std::size_t i = 0;
    for (; i < shapes_.meshes.size() && shapes_.meshes[i].places.empty(); ++i) triangles_add(i, world);
    if (!scene_.triangles.empty()) bvh_append(bvh_, scene_.triangles, 0, scene_.bvh_width, scene_.bvh_rule);
    for (; i < shapes_.meshes.size(); ++i) instances_add(i);
    if (!boxes_.empty()) scene_.instance_root = bvh_append_boxes(bvh_, boxes_, scene_.bvh_width);
    scene_.bvh_nodes = std::move(bvh_.nodes);
    scene_.bvh_blocks = std::move(bvh_.blocks);
    if (dropped_ > 0)
      scene_.notes.push_back(std::to_string(dropped_) + " triangles have no area in single precision and are left out");
    if (lost_ > 0)
      scene_.notes.push_back(std::to_string(lost_) + " instances are too small for single precision and are left out");
  }

 private:
  void triangles_add(std::size_t i, const Space& space) {
    const LoadedMesh& mesh = shapes_.meshes[i];
    for (std::size_t k = mesh.first; k < mesh.first + mesh.count; ++k) {
      const MeshTriangle& t = mesh.mesh->triangles[k];
      const int own = t.material >= 0 ? shapes_.first_material[i] + t.material : shapes_.default_material;
      const Triangle flat =
          triangle_flatten(*mesh.mesh, t, mesh.shading, mesh.material >= 0 ? mesh.material : own, space);
      if (has_area(flat)) {
        scene_.triangles.push_back(flat);
      } else {
        ++dropped_;
      }
    }
  }

  void instances_add(std::size_t i) {
    const LoadedMesh& mesh = shapes_.meshes[i];
    const Space space = space_of(mesh);
    const auto first = static_cast<std::int32_t>(scene_.triangles.size());
    triangles_add(i, space);
    const auto count = static_cast<std::int32_t>(scene_.triangles.size()) - first;
    if (count == 0) return;
    const int root =
        bvh_append(bvh_, scene_.triangles, static_cast<std::size_t>(first), scene_.bvh_width, scene_.bvh_rule);
    for (const MeshPlace& place : mesh.places)
      instance_add(place, flat_from(scene_, place.world_from_mesh * space.from()), root);
    scene_.meshes.push_back({first, count});
  }

  void instance_add(const MeshPlace& place, const dmat4& world_from_mesh, int root) {
    const dmat4 mesh_from_world = glm::inverse(world_from_mesh);
    const dvec3 lo = scene_.point(place.bounds.lo), hi = scene_.point(place.bounds.hi);
    const dvec3 size = glm::max(glm::abs(lo), glm::abs(hi));
    Instance instance{};
    instance.mesh_from_world = affine(mesh_from_world);
    instance.world_from_mesh = affine(world_from_mesh);
    if (!is_finite(instance.mesh_from_world) || !is_finite(instance.world_from_mesh)) {
      ++lost_;
      return;
    }
    instance.root = root;
    instance.mesh = static_cast<int>(scene_.meshes.size());
    instance.material = place.material;
    instance.reach =
        static_cast<float>(std::max(largest(size), REACH_SHARE * round_trip(mesh_from_world, world_from_mesh, size)));
    const double margin = BOX_ROUNDING * round_trip(mesh_from_world, world_from_mesh, glm::max(size, scene_size_));
    instance.lo = packed(lo - margin);
    instance.hi = packed(hi + margin);
    scene_.instances.push_back(instance);
    boxes_.push_back({{instance.lo.x, instance.lo.y, instance.lo.z}, {instance.hi.x, instance.hi.y, instance.hi.z}});
  }

  const LoadedShapes& shapes_;
  FlatScene& scene_;
  dvec3 scene_size_{0};
  FlatBvh bvh_;
  std::vector<BvhBox> boxes_;  // of the instances
  std::size_t dropped_ = 0;    // triangles
  std::size_t lost_ = 0;       // instances
};

}  // namespace

void flatten_meshes(const LoadedShapes& shapes, FlatScene& scene) { MeshFlattener(shapes, scene).run(); }

}  // namespace brume
