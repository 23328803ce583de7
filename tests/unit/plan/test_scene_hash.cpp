// What makes two scenes different pictures, and what does not.
#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "plan/scene_hash.hpp"
#include "unit/plan/flat_scene_builder.hpp"

namespace brume::test {
namespace {

PlannedScene scene_full() {
  PlannedScene scene = scene_empty(8);
  material_add(scene);
  shape_add(scene, SHAPE_SPHERE, {0, 0, 0, 1});
  triangle_add(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  scene.media.push_back({});
  scene.walks.push_back({});
  scene.grids.push_back({});
  scene.placed.push_back({});
  scene.lights.push_back({});
  scene.light_shares = {0, 1};
  scene.textures.push_back({});
  scene.texels = {1, 2, 3};
  scene.bricks = {0};
  scene.brick_ranges = {0, 1};
  scene.voxels = {1, 2, 3, 4};
  scene.light_grids.push_back({});
  return scene;
}

using Change = std::function<void(PlannedScene&)>;

TEST(SceneHash, EveryPartOfAPictureCounts) {
  const std::vector<Change> changes = {
      [](PlannedScene&) {},
      [](PlannedScene& s) { s.origin.y = 1e-9; },
      [](PlannedScene& s) { s.unit = 2; },
      [](PlannedScene& s) { s.frame.background.z = 1; },
      [](PlannedScene& s) { s.frame.hides_background = 1; },
      [](PlannedScene& s) { s.frame.camera.up.y = 1.5f; },
      [](PlannedScene& s) { s.lights[0].type = 1; },
      [](PlannedScene& s) {
        s.light_shares = {0, 0.5f, 1};
      },
      [](PlannedScene& s) { s.materials[0].diffuse.x = 0.5f; },
      [](PlannedScene& s) { s.textures.push_back({}); },
      [](PlannedScene& s) { s.texels[2] = 4; },
      [](PlannedScene& s) { s.shapes[0].data[3] = 2; },
      [](PlannedScene& s) { s.triangles[0].p[1].x = -1; },
      [](PlannedScene& s) { s.triangles.push_back(s.triangles[0]); },
      [](PlannedScene& s) {
        s.meshes.push_back({1, 1});
      },
      [](PlannedScene& s) { s.instances.push_back({}); },
      [](PlannedScene& s) { s.media[0].sigma_s.y = 1; },
      [](PlannedScene& s) { s.bricks[0] = -1; },
      [](PlannedScene& s) { s.brick_ranges[1] = -1; },
      [](PlannedScene& s) { std::swap(s.voxels[0], s.voxels[1]); },
      [](PlannedScene& s) { s.voxels[0] = -1; },  // the highest bit alone
      [](PlannedScene& s) { s.voxels[3] = -4; },
      [](PlannedScene& s) { s.storage = 1; },
      [](PlannedScene& s) { s.light_grids[0].nu = 3; },
      [](PlannedScene& s) { s.walks[0].method = 3; },
      [](PlannedScene& s) { s.grids[0].cells_x = 3; },
      [](PlannedScene& s) { s.placed[0].constant_density = 3; },
  };
  std::set<std::uint64_t> hashes;
  for (const Change& change : changes) {
    PlannedScene scene = scene_full();
    change(scene);
    hashes.insert(scene_hash(scene));
  }
  EXPECT_EQ(hashes.size(), changes.size());
}

TEST(SceneHash, WhereTheBvhOfAMeshBeginsDoesNot) {
  PlannedScene one = scene_full();
  one.instances.push_back({});
  PlannedScene two = one;
  two.instances[0].root = 5;
  EXPECT_EQ(scene_hash(one), scene_hash(two));
  two.instances[0].material = 5;
  EXPECT_NE(scene_hash(one), scene_hash(two));
}

TEST(SceneHash, CropDeviceAndNamesDoNot) {
  const std::vector<Change> changes = {
      [](PlannedScene& s) { s.frame.crop_x0 = 3; },
      [](PlannedScene& s) { s.frame.crop_y1 = 3; },
      [](PlannedScene& s) { s.frame.camera.spp = 9; },
      [](PlannedScene& s) { s.frame.seed = 9; },
      [](PlannedScene& s) { s.frame.camera.width = 9; },
      [](PlannedScene& s) { s.bvh_width = 16; },
      [](PlannedScene& s) { s.bvh_nodes.assign(64, 1.0f); },
      [](PlannedScene& s) { s.name = "other"; },
      [](PlannedScene& s) { s.notes.push_back("note"); },
      [](PlannedScene& s) { s.frame.shape_root = 5; },
      [](PlannedScene& s) { s.frame.list_count = 5; },
      [](PlannedScene& s) { s.frame.instance_root = 5; },
      [](PlannedScene& s) { s.shape_root = 5; },
      [](PlannedScene& s) { s.shape_list.push_back(1); },
  };
  const std::uint64_t hash = scene_hash(scene_full());
  for (std::size_t i = 0; i < changes.size(); ++i) {
    PlannedScene scene = scene_full();
    changes[i](scene);
    EXPECT_EQ(scene_hash(scene), hash) << "change " << i;
  }
}

}  // namespace
}  // namespace brume::test
