// Cells, ∫ρ and scattered light along random rays, by every method in every density that it fits; and by every row of
// the families about media.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <memory>
#include <tuple>

#include "check/check_parts.hpp"
#include "check/ray_moves.hpp"
#include "check/row_scenes.hpp"
#include "reference/medium.hpp"
#include "reference/scatter.hpp"
#include "render/renderer.hpp"
#include "scene/families.hpp"
#include "volume/density_source.hpp"

namespace brume {

namespace {

constexpr int PROBE_SEGMENTS = 128;  // as in kernels/probes/probes.cl
constexpr int SCATTER_SHARE = 8;     // every so many rays scatter: the reference asks both lights in every cell

struct MediumRays {
  std::vector<reference::RayD> rays;
  std::vector<double> ends;
  std::vector<float> packed;  // origin, direction, end
};

MediumRays rays_make(int count) {
  MediumRays out;
  CheckRandom random;
  for (int i = 0; i < count; ++i) {
    reference::RayD ray;
    ray.origin = random.in_box(i % 3 ? 2.5 : 0.9);  // a third begin inside
    ray.dir = dvec3(glm::vec3(glm::normalize(random.in_box(0.9) - ray.origin)));
    const auto end = static_cast<float>(i % 5 ? INFINITY : random.uniform(0.2, 3));
    push3(out.packed, ray.origin);
    push3(out.packed, ray.dir);
    out.packed.push_back(end);
    out.rays.push_back(ray);
    out.ends.push_back(end);
  }
  return out;
}

// With the number of the first medium before each ray.
std::vector<float> in_medium_0(const MediumRays& rays) {
  std::vector<float> in;
  for (std::size_t i = 0; i < rays.rays.size(); ++i) {
    in.push_back(bits_as_float(0));
    in.insert(in.end(), rays.packed.begin() + 7 * i, rays.packed.begin() + 7 * (i + 1));
  }
  return in;
}

PlannedScene medium_scene(const SceneDesc& desc, int lanes) { return row_scene(desc, "fog", 8, bvh_width_for(lanes)); }

reference::RandomStream stream_of(const PlannedScene& scene, std::size_t ray) {
  return {static_cast<uint>(ray), 0, scene.frame.seed};
}

using CellLengths = std::map<std::tuple<int, int, int>, double>;  // of a ray in each cell
std::tuple<int, int, int> cell_key(const glm::ivec3& c) { return {c.x, c.y, c.z}; }

CellLengths lengths_exact(const PlannedScene& scene, const reference::RayD& ray, double end) {
  const Medium medium = scene.medium(0);
  CellLengths lengths;
  const auto interval = reference::medium_interval(medium, ray, 0, end);
  if (interval.empty()) return lengths;
  for (const auto& s : reference::segments(scene, 0, ray, interval.t0, interval.t1, medium.method))
    lengths[cell_key(s.cell)] += s.t_end - s.t_begin;
  return lengths;
}

// found: pairs (t of the middle, length)
CellLengths lengths_found(const PlannedScene& scene, const reference::RayD& ray, const float* found) {
  const Medium medium = scene.medium(0);
  const auto local = reference::ray_to_cells(medium, ray);
  CellLengths lengths;
  for (int k = 0; k < PROBE_SEGMENTS && found[2 * k + 1] > 0; ++k)
    lengths[cell_key(reference::cell_at(medium, local.origin + double(found[2 * k]) * local.dir))] += found[2 * k + 1];
  return lengths;
}

// The largest difference in any cell that either visits.
double lengths_apart(CellLengths a, const CellLengths& b) {
  double worst = 0;
  for (const auto& [cell, length] : b) a[cell] -= length;
  for (const auto& [cell, length] : a) worst = std::max(worst, std::abs(length));
  return worst;
}

CheckCompare cells_prepare(const SceneDesc& desc, int size) {
  return [desc, rays = rays_make(size * size)](Context& context, int lanes, ErrorSum& sum) {
    const PlannedScene scene = medium_scene(desc, lanes);
    const std::vector<float> found =
        Probe(context, scene, lanes).run("probe_segments", in_medium_0(rays), 8, 2 * PROBE_SEGMENTS);
    for (std::size_t i = 0; i < rays.rays.size(); ++i) {
      const reference::RayD& ray = rays.rays[i];
      const CellLengths exact = lengths_exact(scene, ray, rays.ends[i]);
      const double apart = lengths_apart(lengths_found(scene, ray, &found[2 * PROBE_SEGMENTS * i]), exact);
      add_or_edge(sum, {apart}, {0}, [&](int move) -> std::vector<double> {
        return {lengths_apart(lengths_exact(scene, ray_moved(ray, move), rays.ends[i]), exact)};
      });
    }
    sum.set_items(rays.rays.size());
  };
}

CheckCompare integral_prepare(const SceneDesc& desc, int size) {
  const auto rays = std::make_shared<MediumRays>(rays_make(size * size));
  const auto scene = std::make_shared<PlannedScene>(medium_scene(desc, 4));
  const auto depth = [rays, scene](std::size_t i, const reference::RayD& ray) -> std::vector<double> {
    return {reference::optical_depth(*scene, 0, ray, rays->ends[i], scene->medium(0).method, nullptr,
                                     stream_of(*scene, i))};
  };
  std::vector<std::vector<double>> expected;
  for (std::size_t i = 0; i < rays->rays.size(); ++i) expected.push_back(depth(i, rays->rays[i]));
  return [desc, rays, depth, expected](Context& context, int lanes, ErrorSum& sum) {
    const std::vector<float> found =
        Probe(context, medium_scene(desc, lanes), lanes).run("probe_integral", in_medium_0(*rays), 8, 1);
    for (std::size_t i = 0; i < expected.size(); ++i)
      add_or_edge(sum, {found[i]}, expected[i], [&](int move) { return depth(i, ray_moved(rays->rays[i], move)); });
    sum.set_items(expected.size());
  };
}

std::vector<double> scattered_values(const reference::Scattered& s) {
  const dvec3 t = reference::transmittance_of(s.tau);
  return {s.radiance.x, s.radiance.y, s.radiance.z, t.x, t.y, t.z};
}

// Radiance and transmittance; both sides draw the same random numbers.
CheckCompare scatter_prepare(const SceneDesc& desc, int size) {
  const auto rays = std::make_shared<MediumRays>(rays_make(std::max(64, size * size / SCATTER_SHARE)));
  const auto scene = std::make_shared<PlannedScene>(medium_scene(desc, 4));
  const auto context = std::make_shared<reference::Context>(*scene, reference::Options{});
  const auto scattered = [rays, scene, context](std::size_t i, const reference::RayD& ray) {
    return reference::media_scatter(*context, ray, rays->ends[i], stream_of(*scene, i));
  };
  std::vector<std::vector<double>> expected;
  for (std::size_t i = 0; i < rays->rays.size(); ++i) expected.push_back(scattered_values(scattered(i, rays->rays[i])));
  return [desc, rays, scattered, expected](Context& device, int lanes, ErrorSum& sum) {
    const std::vector<float> found =
        Probe(device, medium_scene(desc, lanes), lanes).run("probe_scatter", rays->packed, 7, 6);
    for (std::size_t i = 0; i < expected.size(); ++i)
      add_or_edge(sum, {found.begin() + 6 * i, found.begin() + 6 * (i + 1)}, expected[i],
                  [&](int move) { return scattered_values(scattered(i, ray_moved(rays->rays[i], move))); });
    sum.set_items(expected.size());
  };
}

LightDesc spot_through_fog() {
  LightDesc spot;
  spot.type = LIGHT_SPOT;
  spot.position = {0.3, 1.6, -0.2};
  spot.direction = {-0.3, -1, 0.1};
  spot.angle = 20;
  spot.softness = 0.4;
  return spot;
}

using Prepare = CheckCompare (*)(const SceneDesc&, int size);
Check medium_check(const std::string& name, const char* tolerance, Prepare prepare, const SceneDesc& desc) {
  return {name, tolerance, [prepare, desc](int size) { return prepare(desc, size); }};
}

const char* integral_tolerance(int method) {
  return method_placement(method) == PLACEMENT_CELLS ? "integral" : "grazing";
}

void add_methods(std::vector<Check>& checks) {
  for (const FamilyRow& method : method_family())
    for (const DensityKind& kind : density_kinds()) {
      if (!(method_fits(method.id) & kind.fits)) continue;
      const std::string name = std::string(method.name) + "/" + kind.name;
      const SceneDesc desc = fog_desc(kind, method.id);
      if (method_placement(method.id) == PLACEMENT_CELLS)
        checks.push_back(medium_check("cells/" + name, "cells", cells_prepare, desc));
      if (!method_tracks(method.id))  // trackers have no sum of ∫ρ of their own
        checks.push_back(medium_check("integral/" + name, integral_tolerance(method.id), integral_prepare, desc));
      checks.push_back(medium_check("scatter/" + name, "scatter", scatter_prepare, desc));
    }
}

// One row per row of a family, whose number `set` puts into the scene.
template <class Set>
void add_rows(std::vector<Check>& checks, const std::string& head, const Family& family, const char* tolerance,
              Prepare prepare, Set set) {
  for (const FamilyRow& row : family) {
    SceneDesc desc = fog_desc(density_kinds()[INTERPOLATION_TRILINEAR], METHOD_AUTO);
    set(desc, row.id);
    checks.push_back(medium_check(head + std::string(row.name), tolerance, prepare, desc));
  }
}

// A file is not made here; its grid is one like another.
void add_densities(std::vector<Check>& checks) {
  for (const FamilyRow& row : density_family()) {
    if (row.name == "file") continue;
    SceneDesc desc = fog_desc(density_kinds()[INTERPOLATION_TRILINEAR], METHOD_AUTO);
    desc.media[0].density = density_of(std::string(row.name));
    checks.push_back(medium_check("density/" + std::string(row.name), "grazing", integral_prepare, desc));
  }
}

}  // namespace

std::vector<Check> medium_checks() {
  std::vector<Check> checks;
  add_methods(checks);
  add_densities(checks);
  add_rows(checks, "storage/", storage_family(), "integral", integral_prepare,
           [](SceneDesc& desc, int storage) { desc.render.storage = storage; });
  add_rows(checks, "in_scattering/", in_scattering_family(), "scatter", scatter_prepare,
           [](SceneDesc& desc, int rule) { desc.render.in_scattering = rule; });
  // its steps through a constant medium are its own
  SceneDesc constant = fog_desc(density_kinds().back(), METHOD_AUTO);
  constant.render.in_scattering = IN_SCATTERING_GAUSS2;
  constant.lights.push_back(spot_through_fog());
  checks.push_back(medium_check("in_scattering/gauss2/constant", "scatter", scatter_prepare, constant));
  // turned boxes on one spot, between whose places of light depths are interpolated
  SceneDesc several = fog_desc(density_kinds()[INTERPOLATION_TRILINEAR], METHOD_AUTO);
  for (int i = 1; i < 4; ++i) {
    several.media.push_back(several.media[0]);
    several.media.back().transform.push_back(Rotate{dvec3(0, 1, 0.3), 25.0 * i});
  }
  checks.push_back(medium_check("scatter/media_on_one_spot", "scatter", scatter_prepare, several));
  add_rows(checks, "scatter/phase/", phase_family(), "scatter", scatter_prepare,
           [](SceneDesc& desc, int phase) { desc.media[0].phase = phase; });
  return checks;
}

}  // namespace brume
