// Intersections, any-hit queries and surfaces, shape by shape.
#include <glm/geometric.hpp>

#include "check/check_parts.hpp"
#include "reference/intersect.hpp"
#include "reference/surface.hpp"
#include "shared/ray.h"

namespace brume {

namespace {

struct Rays {
  std::vector<reference::RayD> rays;
  std::vector<float> packed;  // origin, direction, t_max
};

// From around and inside the unit sphere towards points of the scene.
Rays rays_make(int count) {
  Rays out;
  CheckRandom random;
  for (int i = 0; i < count; ++i) {
    reference::RayD ray;
    ray.origin = random.in_box(i % 4 ? 3.0 : 1.0);
    ray.dir = dvec3(glm::vec3(glm::normalize(random.in_box(1.2) - ray.origin)));
    out.rays.push_back(ray);
    for (int k = 0; k < 3; ++k) out.packed.push_back(static_cast<float>(ray.origin[k]));
    for (int k = 0; k < 3; ++k) out.packed.push_back(static_cast<float>(ray.dir[k]));
    out.packed.push_back(INFINITY);
  }
  return out;
}

// The scene with one analytic shape left, or with triangles only.
PlannedScene shape_only(PlannedScene scene, int shape) {
  if (shape < 0) {
    scene.shapes.clear();
  } else {
    scene.shapes = {scene.shapes[shape]};
    scene.triangles.clear();
    scene.frame.triangle_count = 0;
  }
  scene.frame.shape_count = static_cast<int>(scene.shapes.size());
  return scene;
}

CheckRow check_hits(const Probe& probe, const std::string& name, const Rays& rays, std::vector<float>& hits) {
  hits = probe.run("probe_hit", rays.packed, 7, 4);
  ErrorSum sum("hit/" + name, probe.lanes(), "hit");
  const reference::TriangleBounds bounds(probe.scene());
  for (std::size_t i = 0; i < rays.rays.size(); ++i) {
    const auto expected = reference::nearest_hit(probe.scene(), bounds, rays.rays[i]);
    const bool same = (expected.primitive == PRIMITIVE_NONE) == (float_as_bits(hits[4 * i + 1]) == PRIMITIVE_NONE);
    if (same) {
      sum.add(hits[4 * i], expected.t);
    } else {
      sum.add_edge();
    }
  }
  CheckRow row = sum.row();
  row.items = rays.rays.size();
  return row;
}

CheckRow check_occlusion(const Probe& probe, const std::string& name, Rays rays) {
  CheckRandom random;
  for (std::size_t i = 0; i < rays.rays.size(); ++i)
    rays.packed[7 * i + 6] = static_cast<float>(random.uniform(0.1, 5));
  const std::vector<float> found = probe.run("probe_occluded", rays.packed, 7, 1);
  ErrorSum sum("occluded/" + name, probe.lanes(), "hit");
  const reference::TriangleBounds bounds(probe.scene());
  for (std::size_t i = 0; i < rays.rays.size(); ++i) {
    const bool expected = reference::occluded(probe.scene(), bounds, rays.rays[i], rays.packed[7 * i + 6]);
    if (expected == (found[i] != 0)) {
      sum.add(found[i], expected);
    } else {
      sum.add_edge();
    }
  }
  CheckRow row = sum.row();
  row.items = rays.rays.size();
  return row;
}

// Normals and uv at the kernel's own hits.
CheckRow check_surface(const Probe& probe, const std::string& name, const Rays& rays, const std::vector<float>& hits) {
  std::vector<float> in;
  std::vector<reference::SurfaceD> expected;
  for (std::size_t i = 0; i < rays.rays.size(); ++i) {
    const float* hit = &hits[4 * i];
    if (float_as_bits(hit[1]) == PRIMITIVE_NONE) continue;
    in.insert(in.end(), rays.packed.begin() + 7 * i, rays.packed.begin() + 7 * i + 6);
    in.insert(in.end(), hit, hit + 4);
    expected.push_back(
        reference::surface_at(probe.scene(), rays.rays[i], {hit[0], float_as_bits(hit[1]), hit[2], hit[3]}));
  }
  const std::vector<float> found = probe.run("probe_surface", in, 10, 8);
  ErrorSum sum("surface/" + name, probe.lanes(), "surface");
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const float* f = &found[8 * i];
    const reference::SurfaceD& e = expected[i];
    if (glm::dot(e.geometric_normal, dvec3(f[0], f[1], f[2])) < 0.5) {
      sum.add_edge();  // the other side of an edge of a box or a cylinder, or a ray along the surface
      continue;
    }
    for (int k = 0; k < 3; ++k) {
      sum.add(f[k], e.geometric_normal[k]);
      sum.add(f[3 + k], e.normal[k]);
    }
    for (int k = 0; k < 2; ++k) {
      const double turn = std::abs(f[6 + k] - e.uv[k]) > 0.5 ? std::round(f[6 + k] - e.uv[k]) : 0.0;  // the seam of u
      sum.add(f[6 + k] - turn, e.uv[k]);
    }
  }
  return sum.row();
}

}  // namespace

std::vector<CheckRow> check_surfaces(Context& context, int lanes, int items) {
  std::vector<CheckRow> rows;
  const PlannedScene surfaces = check_scene("surfaces", 8, std::max(lanes, 4));
  const PlannedScene mesh = check_scene("mesh", 8, std::max(lanes, 4));
  const char* names[] = {"sphere", "cylinder", "plane", "quad", "box"};
  static_assert(std::size(names) == SHAPE_COUNT);
  const Rays rays = rays_make(items);
  for (int shape = 0; shape <= SHAPE_COUNT; ++shape) {
    const PlannedScene scene = shape < SHAPE_COUNT ? shape_only(surfaces, shape) : shape_only(mesh, -1);
    const std::string name = shape < SHAPE_COUNT ? names[shape] : "triangles";
    const Probe probe(context, scene, lanes);
    std::vector<float> hits;
    rows.push_back(check_hits(probe, name, rays, hits));
    rows.push_back(check_occlusion(probe, name, rays));
    rows.push_back(check_surface(probe, name, rays, hits));
  }
  return rows;
}

}  // namespace brume
