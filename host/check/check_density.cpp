// Density at points, W side by side: every point of an item lies elsewhere, so that lanes differ in brick, emptiness
// and being inside.
#include <algorithm>
#include <glm/common.hpp>

#include "check/check_parts.hpp"
#include "flat/bricks.hpp"
#include "reference/medium.hpp"
#include "scene/families.hpp"

namespace brume {

namespace {

constexpr int PROBE_POINTS = 16;  // as in kernels/probes/probes.cl
constexpr int DENSE = 36;         // samples a side of the corner of the grid that is filled

bool inside(const Medium& m, const dvec3& p) {
  return p.x >= m.lo.x && p.y >= m.lo.y && p.z >= m.lo.z && p.x <= m.hi.x && p.y <= m.hi.y && p.z <= m.hi.z;
}

// Half of the points in the dense corner of the grid, the others anywhere about it; of each, some on borders of cells
// and on the sides.
dvec3 point_make(const Medium& m, CheckRandom& random, int i) {
  const dvec3 lo(m.lo.x, m.lo.y, m.lo.z), hi(m.hi.x, m.hi.y, m.hi.z), middle = 0.5 * (lo + hi);
  const dvec3 at = random.in_box(0.55);
  dvec3 p = i % 2 ? middle + (hi - lo) * at : lo + glm::min(hi - lo, dvec3(DENSE)) * (at + 0.5);
  if (i % 5 == 1) p = glm::floor(p);
  if (i % 5 == 2) p[i % 3] = i % 2 ? hi[i % 3] : lo[i % 3];
  return p;
}

CheckRow check_points(const Probe& probe, const std::string& name, int items) {
  const Medium& m = probe.scene().media[0];
  std::vector<float> packed;
  std::vector<dvec3> points;
  CheckRandom random;
  for (int item = 0; item < items; ++item) {
    packed.push_back(bits_as_float(0));
    for (int i = 0; i < PROBE_POINTS; ++i) {
      const dvec3 p = point_make(m, random, item * PROBE_POINTS + i);
      for (int axis = 0; axis < 3; ++axis) packed.push_back(static_cast<float>(p[axis]));
      const float* rounded = &packed[packed.size() - 3];
      points.push_back({rounded[0], rounded[1], rounded[2]});
    }
  }
  const std::vector<float> found = probe.run("probe_density", packed, 1 + 3 * PROBE_POINTS, PROBE_POINTS);
  ErrorSum sum("density/" + name, probe.lanes(), "density");
  for (std::size_t i = 0; i < points.size(); ++i)
    sum.add(found[i], inside(m, points[i]) ? reference::density_at(probe.scene(), m, points[i]) : 0);
  return sum.row();
}

// A grid with empty bricks, empty blocks of bricks, constant ones, and some of all kinds of values.
FlatScene scattered_scene(int interpolation, int storage, int bvh_width) {
  Grid grid({150, 40, 90});
  grid.border = Border::ZERO;
  CheckRandom random;
  for (ivec3 i(0); i.z < DENSE; ++i.z)
    for (i.y = 0; i.y < DENSE; ++i.y)
      for (i.x = 0; i.x < DENSE; ++i.x) grid.set(i, static_cast<float>(std::max(0.0, random.uniform(-0.2, 1))));
  grid.set(grid.size() - 1, 1.0f);
  grid.fill({70, 8, 8}, {90, 30, 30}, 0.75f);
  FlatScene scene = check_scene("fog_nearest", 4, bvh_width);
  scene.bricks.clear();
  scene.brick_ranges.clear();
  scene.voxels.clear();
  scene.media[0].interpolation = interpolation;
  bricks_append(grid, scene.media[0], scene);
  voxels_pack(scene, storage);
  return scene;
}

}  // namespace

std::vector<CheckRow> check_density(Context& context, int lanes, int items) {
  std::vector<CheckRow> rows;
  const int groups = items / PROBE_POINTS + 1, bvh_width = std::max(lanes, 4);
  for (const FamilyRow& interpolation : interpolation_family())
    for (const FamilyRow& storage : storage_family()) {
      const FlatScene scene = scattered_scene(interpolation.id, storage.id, bvh_width);
      const std::string name = std::string(interpolation.name) + "/" + std::string(storage.name);
      rows.push_back(check_points(Probe(context, scene, lanes), name, groups));
    }
  const FlatScene constant = check_scene("fog_homogeneous", 4, bvh_width);
  rows.push_back(check_points(Probe(context, constant, lanes), "constant", groups));
  return rows;
}

}  // namespace brume
