// What makes two scenes different pictures, and what does not.
#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "flat/scene_hash.hpp"
#include "flat_scene_builder.hpp"

namespace brume::test {
namespace {

FlatScene scene_full() {
  FlatScene scene = scene_empty(8);
  material_add(scene);
  shape_add(scene, SHAPE_SPHERE, {0, 0, 0, 1});
  triangle_add(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  scene.media.push_back({});
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

using Change = std::function<void(FlatScene&)>;

TEST(SceneHash, EveryPartOfAPictureCounts) {
  const std::vector<Change> changes = {
      [](FlatScene&) {},
      [](FlatScene& s) { s.origin.y = 1e-9; },
      [](FlatScene& s) { s.unit = 2; },
      [](FlatScene& s) { s.frame.background.z = 1; },
      [](FlatScene& s) { s.frame.hides_background = 1; },
      [](FlatScene& s) { s.frame.camera.up.y = 1.5f; },
      [](FlatScene& s) { s.lights[0].type = 1; },
      [](FlatScene& s) {
        s.light_shares = {0, 0.5f, 1};
      },
      [](FlatScene& s) { s.materials[0].diffuse.x = 0.5f; },
      [](FlatScene& s) { s.textures.push_back({}); },
      [](FlatScene& s) { s.texels[2] = 4; },
      [](FlatScene& s) { s.shapes[0].data[3] = 2; },
      [](FlatScene& s) { s.triangles[0].p[1].x = -1; },
      [](FlatScene& s) { s.triangles.push_back(s.triangles[0]); },
      [](FlatScene& s) { s.media[0].sigma_s.y = 1; },
      [](FlatScene& s) { s.bricks[0] = -1; },
      [](FlatScene& s) { s.brick_ranges[1] = -1; },
      [](FlatScene& s) { std::swap(s.voxels[0], s.voxels[1]); },
      [](FlatScene& s) { s.voxels[0] = -1; },  // the highest bit alone
      [](FlatScene& s) { s.voxels[3] = -4; },
      [](FlatScene& s) { s.storage = 1; },
      [](FlatScene& s) { s.light_grids[0].nu = 3; },
      [](FlatScene& s) { s.method = 3; },
  };
  std::set<std::uint64_t> hashes;
  for (const Change& change : changes) {
    FlatScene scene = scene_full();
    change(scene);
    hashes.insert(scene_hash(scene));
  }
  EXPECT_EQ(hashes.size(), changes.size());
}

TEST(SceneHash, CropDeviceAndNamesDoNot) {
  const std::vector<Change> changes = {
      [](FlatScene& s) { s.frame.crop_x0 = 3; },
      [](FlatScene& s) { s.frame.crop_y1 = 3; },
      [](FlatScene& s) { s.frame.camera.spp = 9; },
      [](FlatScene& s) { s.frame.seed = 9; },
      [](FlatScene& s) { s.frame.camera.width = 9; },
      [](FlatScene& s) { s.bvh_width = 16; },
      [](FlatScene& s) { s.bvh_nodes.assign(64, 1.0f); },
      [](FlatScene& s) { s.exposure = 2; },
      [](FlatScene& s) { s.name = "other"; },
      [](FlatScene& s) { s.notes.push_back("note"); },
  };
  const std::uint64_t hash = scene_hash(scene_full());
  for (std::size_t i = 0; i < changes.size(); ++i) {
    FlatScene scene = scene_full();
    changes[i](scene);
    EXPECT_EQ(scene_hash(scene), hash) << "change " << i;
  }
}

}  // namespace
}  // namespace brume::test
