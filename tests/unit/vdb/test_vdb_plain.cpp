// brume-volume reads plain files by itself. A grid that only the library reads, beside the others, sends the whole file
// to the library: both have to say the same.
#include <random>

#include "unit/vdb/vdb_fixture.hpp"

using namespace brume;
using namespace brume::test;
using testing::HasSubstr;

namespace {

class VdbPlain : public Vdb {
 protected:
  // Everything that a tree may hold: voxels in several nodes, tiles of two sizes, values that are not active.
  static FloatGrid::Ptr crowd(float background, unsigned seed) {
    const auto grid = Vdb::grid<FloatGrid>("crowd", 1, background);
    std::mt19937 random(seed);
    const auto at = [&](int range) { return static_cast<int>(random() % unsigned(range)) - range / 2; };
    for (int i = 0; i < 300; ++i)
      grid->tree().setValueOn({at(40), at(300), at(5000)}, float(random() % 1000) / 512 + 0.25f);
    grid->fill(CoordBBox({64, 64, 64}, {79, 71, 71}), 2.5f);      // leaves' size
    grid->fill(CoordBBox({128, 0, 128}, {255, 127, 255}), 1.5f);  // of a node
    if (seed % 2) {
      grid->tree().addTile(1, {200, 200, 200}, background, true);
      grid->tree().setValueOff({3, 4, 6}, background + 0.5f);
      grid->tree().setValueOff({3, 4, 7}, background + 0.75f);
    }
    if (seed % 3) grid->setTransform(openvdb::math::Transform::createLinearTransform(0.25));
    if (seed % 3 == 2) grid->transform().postTranslate({1, 2, 3});
    return grid;
  }
  fs::path file_packed(const openvdb::GridPtrVec& grids, const std::string& name, std::uint32_t compression) {
    openvdb::io::File to((folder_ / name).string());
    to.setCompression(compression);
    to.write(grids);
    return folder_ / name;
  }
};

void expect_same(const Grid& plain, const Grid& library) {
  ASSERT_EQ(plain.size(), library.size());
  EXPECT_EQ(plain.world_from_lattice, library.world_from_lattice);
  EXPECT_EQ(plain.stored_bytes(), library.stored_bytes());
  EXPECT_EQ(plain.notes.size(), library.notes.size());
  std::size_t others = 0;
  grid_visit_blocks(library, [&](ivec3 b) {
    if (plain.block_empty(b) || !std::equal(library.block(b), library.block(b) + 512, plain.block(b))) ++others;
  });
  EXPECT_EQ(others, 0u);
}

TEST_F(VdbPlain, SaysWhatTheLibrarySays) {
  using namespace openvdb::io;
  unsigned seed = 0;
  for (const std::uint32_t packed : {0u, 1u, 2u, 3u, 4u, 6u})
    for (const bool half : {false, true}) {
      ++seed;
      const auto grid = crowd(seed % 2 ? 0.0f : 1e-7f, seed / 2);
      grid->setSaveFloatAsHalf(half);
      if (seed % 4 == 0) grid->setGridClass(openvdb::GRID_FOG_VOLUME);
      const fs::path plain = file_packed({grid}, "plain.vdb", packed);
      const fs::path mixed = file_packed({grid, grid_named("vec3s", "other")}, "mixed.vdb", packed);
      SCOPED_TRACE("compression " + std::to_string(packed) + ", half " + std::to_string(half) + ", seed " +
                   std::to_string(seed));
      expect_same(volume_read(plain), volume_read(mixed, "crowd"));
      const VolumeGridInfo own = volume_list(plain).at(0), theirs = volume_list(mixed).at(0);
      EXPECT_EQ(own.type, theirs.type);
      EXPECT_EQ(own.grid_class, theirs.grid_class);
      EXPECT_EQ(own.active_voxels, theirs.active_voxels);
      EXPECT_EQ(own.index_min, theirs.index_min);
      EXPECT_EQ(own.index_max, theirs.index_max);
      EXPECT_EQ(own.background, theirs.background);
      EXPECT_EQ(own.voxel_size, theirs.voxel_size);
    }
}

// Wherever a file ends too early, the library finds it again and says so.
TEST_F(VdbPlain, CutFilesAreRefusedAsBefore) {
  const std::string bytes = bytes_of(file({crowd(0, 1)}, "whole.vdb"));
  for (std::size_t end = 0; end < bytes.size(); end += bytes.size() / 7 + 1)
    EXPECT_THAT(refusal(file(bytes.substr(0, end))), HasSubstr(": ")) << end;
}

// The level set of a ball: inactive values on both sides of the surface, of which the inner ones count.
TEST_F(VdbPlain, FillsLevelSets) {
  const auto ball = FloatGrid::create(3.0f);
  ball->setName("ball");
  ball->setGridClass(openvdb::GRID_LEVEL_SET);
  for (auto x = -20; x <= 20; ++x)
    for (auto y = -20; y <= 20; ++y)
      for (auto z = -20; z <= 20; ++z) {
        const float distance = std::sqrt(float(x * x + y * y + z * z)) - 15;
        if (std::abs(distance) < 3)
          ball->tree().setValueOn({x, y, z}, distance);
        else if (distance < 0)
          ball->tree().setValueOff({x, y, z}, -3.0f);
      }
  VolumeValues fill;
  fill.fill = true;
  expect_same(volume_read(file({ball}), "", fill),
              volume_read(file({ball, grid_named("vec3s", "other")}, "mixed.vdb"), "ball", fill));
}

}  // namespace
