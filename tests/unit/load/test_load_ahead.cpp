// What is loaded ahead is there when it is asked for; what cannot be loaded says so then, and not before.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "base/error.hpp"
#include "load/load_ahead.hpp"
#include "load/scene_files.hpp"

namespace brume {
namespace {

MediumDesc perlin(int seed) {
  MediumDesc medium;
  medium.density.type = "perlin";
  medium.density.resolution = {8, 8, 8};
  medium.density.seed = seed;
  return medium;
}

TEST(LoadAhead, LoadsDensitiesOnce) {
  SceneDesc desc;
  desc.media = {perlin(1), perlin(2), perlin(1), MediumDesc{}};
  desc.media[1].emission_density = std::make_shared<DensityDesc>(perlin(3).density);
  LoadedScene loaded;
  { const LoadAhead ahead(loaded, desc); }
  EXPECT_EQ(loaded.costs().size(), 3u);  // a constant is none
  const std::shared_ptr<Grid> grid = loaded.grid(desc.media[0].density);
  EXPECT_EQ(loaded.costs().size(), 3u);
  EXPECT_EQ(grid.use_count(), 2) << "the thread holds nothing any more";
}

TEST(LoadAhead, WhatCannotBeLoadedIsToldWhenItIsAskedFor) {
  SceneDesc desc;
  desc.media = {perlin(1), MediumDesc{}};
  desc.media[1].density.type = "file";
  desc.media[1].density.file = "/nowhere/a.vdb";
  desc.shapes.push_back({MeshDesc{"/nowhere/a.obj", {}, {}, {}, {}, {}}, -1, "/shapes/0"});
  LoadedScene loaded;
  { const LoadAhead ahead(loaded, desc); }
  EXPECT_EQ(loaded.costs().size(), 1u);
  EXPECT_THROW(loaded.grid(desc.media[1].density), InputError);
  EXPECT_THROW(loaded.mesh("/nowhere/a.obj"), InputError);
}

TEST(LoadAhead, AnotherFrameSharesWhatItNamesToo) {
  SceneDesc desc, next;
  desc.media = {perlin(1), perlin(2)};
  next.media = {perlin(2), perlin(3)};
  LoadedScene loaded;
  { const LoadAhead ahead(loaded, desc); }
  LoadedScene shared = loaded.shared_with(next);
  ASSERT_EQ(shared.costs().size(), 1u);
  EXPECT_EQ(shared.grid(next.media[0].density), loaded.grid(desc.media[1].density));
  EXPECT_TRUE(LoadedScene().shared_with(next).costs().empty());
}

// Textures that a mesh names are shared with it.
TEST(LoadAhead, AnotherFrameSharesTexturesOfMeshes) {
  const std::filesystem::path folder = std::filesystem::path(BRUME_SOURCE_DIR) / "scenes/data";
  SceneDesc desc;
  desc.shapes.push_back({MeshDesc{folder / "lighthouse.obj", {}, {}, {}, {}, {}}, -1, "/shapes/0"});
  LoadedScene loaded;
  loaded.mesh(folder / "lighthouse.obj");
  loaded.texture(folder / "lighthouse.png");
  loaded.texture(folder / "sea.png");
  loaded.texture(folder / "../pictures/fire.jpg");  // of nothing that the next frame names
  EXPECT_EQ(loaded.shared_with(desc).costs().size(), 3u);
}

TEST(LoadAhead, FilesOfASceneAreListed) {
  SceneDesc desc;
  desc.media = {perlin(1), MediumDesc{}, MediumDesc{}};
  desc.media[1].density.type = "file";
  desc.media[1].density.file = "a.vdb";
  desc.media[1].emission_density = std::make_shared<DensityDesc>(desc.media[1].density);
  desc.media[1].emission_density->file = "flame.vdb";
  desc.media[2].density.type = "sphere";
  desc.media[2].density.of = std::make_shared<DensityDesc>(desc.media[1].density);
  desc.shapes.push_back({MeshDesc{"a.obj", {}, {}, {}, {}, {}}, -1, "/shapes/0"});
  desc.materials.resize(2);
  desc.materials[1].texture.emplace().file = "a.png";
  EXPECT_THAT(scene_files(desc).paths(), testing::ElementsAre("a.vdb", "flame.vdb", "a.vdb", "a.obj", "a.png"));
}

}  // namespace
}  // namespace brume
