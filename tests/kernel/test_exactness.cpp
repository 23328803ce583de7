// Optical depths of the exact methods against the double reference: 100 000 random rays on each grid.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "check/check_parts.hpp"
#include "plan/planned_scene.hpp"
#include "reference/medium.hpp"
#include "scene/scene_reader.hpp"

namespace brume {
namespace {

constexpr int RAYS = 100000;

// Relative to the optical depth of each ray. Seven roundings of 2^-24 make 4.2e-7: the quotient and product of a
// crossing (3), the interpolation (2), the product with the length and the sum (2). A walk of n cells adds n terms;
// with lanes and batches the sum is a tree over which roundings grow slower than n: one more such constant per 64 cells
// holds with room.
//
// The rays begin inside, at multiples of 2^-10 of a cell, and voxels have sides of powers of two: origin and direction
// in cell space are exact then, and what is measured is the method. In general the origin carries half a digit, which a
// ray that leaves almost along a face magnifies by 1/|d|: that is how well the question is posed, and no method can be
// better (`integral` and `grazing` of brume check).
constexpr double allowed(double cells) { return 4e-7 * (1 + cells / 64); }

struct Lattice {
  const char* name;
  dvec3 cells;
  dvec3 side;  // of a voxel, powers of two
};

PlannedScene scene_of(const Lattice& lattice, const char* method, const char* interpolation) {
  const dvec3 half = 0.5 * lattice.cells * lattice.side;
  char text[600];
  std::snprintf(text, sizeof text,
                R"({"media": [{"interpolation": "%s", "bounds": [[%g, %g, %g], [%g, %g, %g]], "sigma_a": 1,
    "density": {"type": "perlin", "resolution": [%g, %g, %g], "scale": 3, "octaves": 2, "seed": 5}}], "render": {"method": "%s"}})",
                interpolation, -half.x, -half.y, -half.z, half.x, half.y, half.z, lattice.cells.x, lattice.cells.y,
                lattice.cells.z, method);
  PlannedScene scene = flatten(scene_read_text(text, "exact.json", {}), {8, {}});
  EXPECT_EQ(scene.origin, dvec3(0));
  return scene;
}

struct Rays {
  std::vector<reference::RayD> rays;
  std::vector<float> packed;  // medium, origin, direction, t_max
};

Rays rays_make(const Lattice& lattice, double unit) {
  const dvec3 side = lattice.side / unit;
  Rays out;
  CheckRandom random;
  for (int i = 0; i < RAYS; ++i) {
    const dvec3 from = glm::round(random.in_box(0.5) * lattice.cells * 1024.0) / 1024.0 * side;
    const dvec3 to = random.in_box(0.5) * lattice.cells * side;
    const dvec3 dir(glm::vec3(glm::normalize(to - from)));
    out.rays.push_back({from, dir});
    out.packed.push_back(bits_as_float(0));
    for (int k = 0; k < 3; ++k) out.packed.push_back(static_cast<float>(from[k]));
    for (int k = 0; k < 3; ++k) out.packed.push_back(static_cast<float>(dir[k]));
    out.packed.push_back(INFINITY);
  }
  return out;
}

void expect_exact(const Lattice& lattice, const char* method, const char* interpolation, int lanes) {
  static Context context(device_choose("portable computing language"));
  const PlannedScene scene = scene_of(lattice, method, interpolation);
  const Medium medium = scene.medium(0);
  const Rays rays = rays_make(lattice, scene.unit);
  const std::vector<float> found = Probe(context, scene, lanes).run("probe_integral", rays.packed, 8, 1);
  double worst = 0;
  int above = 0;
  for (int i = 0; i < RAYS; ++i) {
    double depth = 0, cells = 0;
    for (const auto& s : reference::segments(scene, 0, rays.rays[i], 0, INFINITY, medium.method)) {
      depth += s.density_length;
      ++cells;
    }
    const double error = found[i] == depth ? 0 : std::abs(found[i] - depth) / depth / allowed(cells);
    above += !(error <= 1);
    worst = std::max(worst, error);
  }
  EXPECT_EQ(above, 0) << lattice.name << ", " << method << ", " << lanes << " lanes: worst " << worst
                      << " of what is allowed";
  testing::Test::RecordProperty(std::string(method) + "_" + std::to_string(int(lattice.cells.x)),
                                std::to_string(worst));
  std::printf("%s, %s, %d lanes: worst %.2f of what is allowed\n", lattice.name, method, lanes, worst);
}

constexpr double S = 1.0 / 32;
const Lattice LATTICES[] = {{"1x1x1", {1, 1, 1}, {1, 1, 1}},
                            {"1x1x64", {1, 1, 64}, {1, 1, S}},
                            {"64x64x64", {64, 64, 64}, {S, S, S}},
                            {"7x5x3", {7, 5, 3}, {0.25, 0.25, 0.25}},
                            {"33x20x9 of 1:4:16", {33, 20, 9}, {S, 4 * S, 16 * S}}};

TEST(Exactness, HundredThousandRaysOnEachLattice) {
  for (const Lattice& lattice : LATTICES)
    for (const int lanes : {1, 8}) {
      expect_exact(lattice, "dda_nearest", "nearest", lanes);
      expect_exact(lattice, "dda_gauss2", "trilinear", lanes);
    }
}

}  // namespace
}  // namespace brume
