// Intersections, any-hit queries and surfaces, shape by shape.
#include <cmath>
#include <glm/geometric.hpp>

#include "check/check_parts.hpp"
#include "check/ray_moves.hpp"
#include "check/row_scenes.hpp"
#include "reference/intersect.hpp"
#include "reference/surface.hpp"
#include "render/renderer.hpp"
#include "scene/families.hpp"
#include "shared/ray.h"

namespace brume {

namespace {

constexpr int HIT_VALUES = 5;  // of probe_hit

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
    push3(out.packed, ray.origin);
    push3(out.packed, ray.dir);
    out.packed.push_back(INFINITY);
  }
  return out;
}

using SceneMake = std::function<PlannedScene(int bvh_width)>;

CheckCompare hit_prepare(const SceneMake& make, int size) {
  return [make, rays = rays_make(size * size)](Context& context, int lanes, ErrorSum& sum) {
    const PlannedScene scene = make(bvh_width_for(lanes));
    const std::vector<float> hits = Probe(context, scene, lanes).run("probe_hit", rays.packed, 7, HIT_VALUES);
    const reference::TriangleBounds bounds(scene);
    for (std::size_t i = 0; i < rays.rays.size(); ++i) {
      const auto expected = reference::nearest_hit(scene, bounds, rays.rays[i]);
      const bool same =
          (expected.primitive == PRIMITIVE_NONE) == (float_as_bits(hits[HIT_VALUES * i + 1]) == PRIMITIVE_NONE);
      if (same) {
        add_or_edge(sum, {hits[HIT_VALUES * i]}, {expected.t}, [&](int move) -> std::vector<double> {
          return {reference::nearest_hit(scene, bounds, ray_moved(rays.rays[i], move)).t};
        });
      } else {
        sum.add_edge();
      }
    }
    sum.set_items(rays.rays.size());
  };
}

CheckCompare occluded_prepare(const SceneMake& make, int size) {
  Rays rays = rays_make(size * size);
  CheckRandom random;
  for (std::size_t i = 0; i < rays.rays.size(); ++i)
    rays.packed[7 * i + 6] = static_cast<float>(random.uniform(0.1, 5));
  return [make, rays](Context& context, int lanes, ErrorSum& sum) {
    const PlannedScene scene = make(bvh_width_for(lanes));
    const std::vector<float> found = Probe(context, scene, lanes).run("probe_occluded", rays.packed, 7, 1);
    const reference::TriangleBounds bounds(scene);
    for (std::size_t i = 0; i < rays.rays.size(); ++i) {
      const bool expected = reference::occluded(scene, bounds, rays.rays[i], rays.packed[7 * i + 6]);
      if (expected == (found[i] != 0)) {
        sum.add(found[i], expected);
      } else {
        sum.add_edge();
      }
    }
    sum.set_items(rays.rays.size());
  };
}

void surface_add(ErrorSum& sum, const float* found, const reference::SurfaceD& expected) {
  if (glm::dot(expected.geometric_normal, dvec3(found[0], found[1], found[2])) < 0.5) {
    sum.add_edge();  // the other side of an edge of a box or a cylinder, or a ray along the surface
    return;
  }
  add3(sum, found, expected.geometric_normal);
  add3(sum, found + 3, expected.normal);
  for (int k = 0; k < 2; ++k) {
    const double off = found[6 + k] - expected.uv[k];
    sum.add(found[6 + k] - (std::abs(off) > 0.5 ? std::round(off) : 0.0), expected.uv[k]);  // the seam of u
  }
}

// Kernels ask for the uv of what has a texture alone.
PlannedScene textured(PlannedScene scene) {
  scene.textures.assign(1, Texture{});
  scene.textures[0].type = TEXTURE_CHECKER;
  for (Material& material : scene.materials) material.texture = 0;
  return scene;
}

// Normals and uv at the kernel's own hits.
CheckCompare surface_prepare(const SceneMake& make, int size) {
  return [make, rays = rays_make(size * size)](Context& context, int lanes, ErrorSum& sum) {
    const PlannedScene scene = textured(make(bvh_width_for(lanes)));
    const Probe probe(context, scene, lanes);
    const std::vector<float> hits = probe.run("probe_hit", rays.packed, 7, HIT_VALUES);
    std::vector<float> in;
    std::vector<reference::SurfaceD> expected;
    for (std::size_t i = 0; i < rays.rays.size(); ++i) {
      const float* hit = &hits[HIT_VALUES * i];
      if (float_as_bits(hit[1]) == PRIMITIVE_NONE) continue;
      in.insert(in.end(), rays.packed.begin() + 7 * i, rays.packed.begin() + 7 * i + 6);
      in.insert(in.end(), hit, hit + HIT_VALUES);
      expected.push_back(reference::surface_at(scene, rays.rays[i],
                                               {hit[0], float_as_bits(hit[1]), hit[2], hit[3], float_as_bits(hit[4])}));
    }
    if (expected.empty()) return;  // no items: missed
    const std::vector<float> found = probe.run("probe_surface", in, 6 + HIT_VALUES, 8);
    for (std::size_t i = 0; i < expected.size(); ++i) surface_add(sum, &found[8 * i], expected[i]);
  };
}

}  // namespace

std::vector<Check> surface_checks() {
  std::vector<std::pair<std::string, SceneMake>> scenes;
  for (const FamilyRow& row : shape_family())
    if (row.id < SHAPE_COUNT)
      scenes.emplace_back(row.name,
                          [type = row.id](int width) { return row_scene(shape_desc(type), "shape", 8, width); });
  scenes.emplace_back("instances", [](int width) { return check_scene("instances", 8, width); });
  scenes.emplace_back("triangles", [](int width) { return check_scene("mesh", 8, width); });
  std::vector<Check> checks;
  for (const auto& [name, make] : scenes) {
    checks.push_back({"hit/" + name, "hit", [make = make](int size) { return hit_prepare(make, size); }});
    checks.push_back({"occluded/" + name, "hit", [make = make](int size) { return occluded_prepare(make, size); }});
    checks.push_back({"surface/" + name, "surface", [make = make](int size) { return surface_prepare(make, size); }});
  }
  return checks;
}

}  // namespace brume
