// DDA cells and ∫ρ along random rays, for every method and interpolation that fit.
#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>

#include "check/check_parts.hpp"
#include "reference/medium.hpp"
#include "scene/families.hpp"

namespace brume {

namespace {

constexpr int PROBE_SEGMENTS = 128;  // as in kernels/probes/probes.cl

struct MediumRays {
  std::vector<reference::RayD> rays;
  std::vector<double> ends;
  std::vector<float> packed;
};

MediumRays rays_make(int count) {
  MediumRays out;
  CheckRandom random;
  for (int i = 0; i < count; ++i) {
    reference::RayD ray;
    ray.origin = random.in_box(i % 3 ? 2.5 : 0.9);  // a third begin inside
    ray.dir = dvec3(glm::vec3(glm::normalize(random.in_box(0.9) - ray.origin)));
    const auto end = static_cast<float>(i % 5 ? INFINITY : random.uniform(0.2, 3));
    out.packed.push_back(bits_as_float(0));
    for (int k = 0; k < 3; ++k) out.packed.push_back(static_cast<float>(ray.origin[k]));
    for (int k = 0; k < 3; ++k) out.packed.push_back(static_cast<float>(ray.dir[k]));
    out.packed.push_back(end);
    out.rays.push_back(ray);
    out.ends.push_back(end);
  }
  return out;
}

using Cell = std::tuple<int, int, int>;
Cell cell_key(const glm::ivec3& c) { return {c.x, c.y, c.z}; }

// Length of the ray in each cell, kernel against reference: every cell that either visits counts. Relative to the whole chord.
CheckRow check_cells(const Probe& probe, const std::string& name, const MediumRays& rays, int method) {
  const std::vector<float> found = probe.run("probe_segments", rays.packed, 8, 2 * PROBE_SEGMENTS);
  const Medium medium = probe.scene().medium(0);
  ErrorSum sum("cells/" + name, probe.lanes(), "cells");
  for (std::size_t i = 0; i < rays.rays.size(); ++i) {
    std::map<Cell, double> lengths;
    const auto interval = reference::medium_interval(medium, rays.rays[i], 0, rays.ends[i]);
    if (!interval.empty())
      for (const auto& s : reference::segments(probe.scene(), 0, rays.rays[i], interval.t0, interval.t1, method))
        lengths[cell_key(s.cell)] -= s.t_end - s.t_begin;
    const auto local = reference::ray_to_cells(medium, rays.rays[i]);
    const float* f = &found[2 * PROBE_SEGMENTS * i];
    for (int k = 0; k < PROBE_SEGMENTS && f[2 * k + 1] > 0; ++k)
      lengths[cell_key(reference::cell_at(medium, local.origin + double(f[2 * k]) * local.dir))] += f[2 * k + 1];
    double different = 0;
    for (const auto& [cell, length] : lengths) different += std::abs(length);
    sum.add(different, 0);
  }
  return sum.row();
}

CheckRow check_integral(const Probe& probe, const std::string& name, const MediumRays& rays, int method) {
  const std::vector<float> found = probe.run("probe_integral", rays.packed, 8, 1);
  const bool dda = method == METHOD_DDA_NEAREST || method == METHOD_DDA_GAUSS2 || method == METHOD_DDA_MIDPOINT;
  ErrorSum sum("integral/" + name, probe.lanes(), dda ? "integral" : "grazing");
  for (std::size_t i = 0; i < rays.rays.size(); ++i)
    sum.add(found[i], reference::optical_depth(probe.scene(), 0, rays.rays[i], rays.ends[i], method));
  return sum.row();
}

}  // namespace

std::vector<CheckRow> check_media(Context& context, int lanes, int items) {
  std::vector<CheckRow> rows;
  const MediumRays rays = rays_make(items);
  for (const char* scene_name : {"fog_nearest", "fog_gauss2", "fog_midpoint", "fog_march", "fog_homogeneous"}) {
    const PlannedScene scene = check_scene(scene_name, 8, std::max(lanes, 4));
    const Medium medium = scene.medium(0);
    const std::string name = std::string(family_name(method_family(), medium.method)) + "/" +
                             std::string(family_name(interpolation_family(), medium.interpolation));
    const Probe probe(context, scene, lanes);
    if (medium.method == METHOD_DDA_NEAREST || medium.method == METHOD_DDA_GAUSS2)
      rows.push_back(check_cells(probe, name, rays, medium.method));
    rows.push_back(check_integral(probe, name, rays, medium.method));
  }
  return rows;
}

}  // namespace brume
