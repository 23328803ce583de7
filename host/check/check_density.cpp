// Density at points, W side by side: every point of an item lies elsewhere, so that lanes differ in brick, emptiness
// and being inside.
#include <algorithm>
#include <glm/common.hpp>
#include <memory>

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

// Points of all items, as the probe takes them and as the reference does.
struct Points {
  std::vector<float> packed;
  std::vector<dvec3> points;
};

Points points_make(const Medium& m, int items) {
  Points out;
  CheckRandom random;
  for (int item = 0; item < items; ++item) {
    out.packed.push_back(bits_as_float(0));
    for (int i = 0; i < PROBE_POINTS; ++i) {
      const dvec3 p = point_make(m, random, item * PROBE_POINTS + i);
      for (int axis = 0; axis < 3; ++axis) out.packed.push_back(static_cast<float>(p[axis]));
      const float* rounded = &out.packed[out.packed.size() - 3];
      out.points.push_back({rounded[0], rounded[1], rounded[2]});
    }
  }
  return out;
}

CheckCompare points_prepare(const std::shared_ptr<const PlannedScene>& scene, int size) {
  const Medium m = scene->medium(0);
  auto points = std::make_shared<const Points>(points_make(m, size * size / PROBE_POINTS + 1));
  return [scene, m, points](Context& context, int lanes, ErrorSum& sum) {
    const std::vector<float> found =
        Probe(context, *scene, lanes).run("probe_density", points->packed, 1 + 3 * PROBE_POINTS, PROBE_POINTS);
    for (std::size_t i = 0; i < points->points.size(); ++i) {
      const dvec3& p = points->points[i];
      sum.add(found[i], inside(m, p) ? reference::density_at(*scene, m, p) : 0);
    }
  };
}

// A grid with empty bricks, empty blocks of bricks, constant ones, and some of all kinds of values.
PlannedScene scattered_scene(int interpolation, int storage) {
  Grid grid({150, 40, 90});
  grid.border = Border::ZERO;
  CheckRandom random;
  for (ivec3 i(0); i.z < DENSE; ++i.z)
    for (i.y = 0; i.y < DENSE; ++i.y)
      for (i.x = 0; i.x < DENSE; ++i.x) grid.set(i, static_cast<float>(std::max(0.0, random.uniform(-0.2, 1))));
  grid.set(grid.size() - 1, 1.0f);
  grid.fill({70, 8, 8}, {90, 30, 30}, 0.75f);
  PlannedScene scene = check_scene("fog_nearest", 4, 8);
  scene.bricks.clear();
  scene.brick_ranges.clear();
  scene.voxels.clear();
  Medium m = scene.medium(0);
  m.interpolation = scene.placed[0].interpolation = interpolation;
  bricks_append(grid, m, scene);
  scene.grids[0] = brick_grid_of(m);
  scene.placed[0].lo = m.lo;
  scene.placed[0].hi = m.hi;
  scene.storage = storage;
  if (storage == STORAGE_F32) return scene;
  const auto stored = std::make_shared<StoredVoxels>(voxels_store(scene, storage, scene.voxels));
  scene.brick_ranges = stored->ranges;
  scene.stored = stored;
  return scene;
}

}  // namespace

std::vector<Check> density_checks() {
  std::vector<Check> checks;
  for (const FamilyRow& interpolation : interpolation_family())
    for (const FamilyRow& storage : storage_family())
      checks.push_back({"points/" + std::string(interpolation.name) + "/" + std::string(storage.name), "density",
                        [i = interpolation.id, s = storage.id](int size) {
                          return points_prepare(std::make_shared<const PlannedScene>(scattered_scene(i, s)), size);
                        }});
  checks.push_back({"points/constant", "density", [](int size) {
                      return points_prepare(std::make_shared<const PlannedScene>(check_scene("fog_homogeneous", 4, 8)),
                                            size);
                    }});
  return checks;
}

}  // namespace brume
