// OpenVDB files that are refused: no densities, too large, damaged.
#include "unit/vdb/vdb_fixture.hpp"

#include <sys/resource.h>

#include <cmath>
#include <random>

using namespace brume;
using namespace brume::test;
using testing::AllOf;
using testing::HasSubstr;
using testing::Ne;

namespace {

using VdbRefused = Vdb;

TEST_F(VdbRefused, RefusesWhatIsNoDensity) {
  EXPECT_THAT(refusal(file({grid_named("vec3s", "wind")})), HasSubstr("grid 'wind': holds vec3s values"));
  EXPECT_THAT(refusal(file({grid("density", 1.0f, 0.5f)})),
              HasSubstr("grid 'density': has the background 0.5; allowed is 0"));
  const auto level_set = grid();
  level_set->setGridClass(openvdb::GRID_LEVEL_SET);
  EXPECT_THAT(refusal(file({level_set})), HasSubstr("is a level set; \"level_set\": \"fill\" fills it"));
  const auto frustum = grid();
  frustum->setTransform(
      openvdb::math::Transform::createFrustumTransform(openvdb::BBoxd({0, 0, 0}, {9, 9, 9}), 0.5, 10));
  EXPECT_THAT(refusal(file({frustum})), AllOf(HasSubstr("NonlinearFrustumMap"), HasSubstr("linear")));
  const auto huge = grid();
  huge->setTransform(openvdb::math::Transform::createLinearTransform(1e200));
  EXPECT_THAT(refusal(file({huge})), HasSubstr("not finite"));
}

TEST_F(VdbRefused, RefusesValuesThatAreNoDensity) {
  for (float bad : {NAN, INFINITY, -INFINITY}) {
    const auto g = grid();
    g->tree().setValueOn(Coord(7, 4, 5), bad);
    g->tree().setValueOn(Coord(8, 4, 5), bad);
    EXPECT_THAT(refusal(file({g})), AllOf(HasSubstr("grid 'density': 2 voxels"), HasSubstr("index [7, 4, 5]"))) << bad;
  }
  EXPECT_THAT(refusal(file({grid("density", -0.5f)})),
              AllOf(HasSubstr("1 voxels are negative"), HasSubstr("index [3, 4, 5] with -0.5;")));
}

// What simulations leave of numbers that should be 0 is cleaned and told, as it is in the file: small numbers are not
// 0.
TEST_F(VdbRefused, RoundingIsCleaned) {
  const auto g = grid();
  g->tree().setValueOn(Coord(7, 4, 5), -1e-9f);
  const Grid read = volume_read(file({g}));
  EXPECT_EQ(read.at({4, 0, 0}), 0.0f);
  EXPECT_THAT(read.notes, testing::ElementsAre(AllOf(HasSubstr("1 voxels are negative"), HasSubstr("with -1e-09"))));
  VolumeValues refuse;
  refuse.clamp_negative = false;
  EXPECT_THROW(volume_read(file({g}), "", refuse), InputError);
  g->tree().setValueOn(Coord(7, 4, 5), -2e-5f);
  EXPECT_THAT(refusal(file({g})), HasSubstr("rounding down to -1e-5 of the largest, 1"));
}

TEST_F(VdbRefused, BackgroundsThatAreRounding) {
  for (const float rounding : {1e-6f, -1e-9f}) {
    const Grid read = volume_read(file({grid("density", 1.0f, rounding)}));
    EXPECT_THAT(read.notes, testing::ElementsAre(HasSubstr("its background"))) << rounding;
  }
  EXPECT_THAT(refusal(file({grid("density", 1.0f, 1e-4f)})), HasSubstr("has the background 0.0001"));
}

// A frame of a sequence in which there is no smoke yet.
TEST_F(VdbRefused, AnEmptyGridIsZero) {
  const Grid read = volume_read(file({FloatGrid::create()}));
  EXPECT_EQ(read.size(), ivec3(1));
  EXPECT_EQ(grid_stats(read).nonzero, 0u);
  EXPECT_TRUE(read.notes.empty());
}

TEST_F(VdbRefused, VoxelsThatAreNotActiveAreZeroAndTold) {
  const auto g = grid();
  g->tree().setValueOff(Coord(4, 4, 5), 3.0f);
  g->tree().setValueOn(Coord(5, 4, 5), 2.0f);
  const Grid read = volume_read(file({g}));
  EXPECT_EQ(read.at({1, 0, 0}), 0.0f);
  EXPECT_EQ(read.at({2, 0, 0}), 2.0f);
  EXPECT_THAT(read.notes, testing::ElementsAre(HasSubstr("1 voxels hold values but are not active")));
}

TEST_F(VdbRefused, RefusesGridsThatAskForTooMuch) {
  const auto far = grid();
  far->tree().setValueOn(Coord(2000000000, 2000000000, 2000000000), 1.0f);
  EXPECT_THAT(refusal(file({far})),
              AllOf(HasSubstr("1999999998x1999999997x1999999996"), HasSubstr("allowed are 134217728")));
}

// 2³⁰ samples of one value in a file of 2 kB: blocks of one value are held once.
TEST_F(VdbRefused, LargeTilesCostLittle) {
  const auto tiles = grid();
  tiles->fill(CoordBBox(Coord(0), Coord(1023)), 0.5f);
  const Grid read = volume_read(file({tiles}));
  EXPECT_EQ(read.size(), ivec3(1024));
  EXPECT_EQ(read.at({1023, 7, 512}), 0.5f);
  EXPECT_LT(read.stored_bytes(), 1u << 20);
  EXPECT_EQ(grid_stats(read).nonzero, std::size_t(1) << 30);
  EXPECT_EQ(grid_stats(read).mean, 0.5);
}

// Tools that change a grid and copy its metadata leave the old.
TEST_F(VdbRefused, StaleMetadataAreTold) {
  const auto write = [&](const std::string& key, const openvdb::Metadata& value) {
    const auto g = grid();
    g->insertMeta(key, value);
    openvdb::io::File out((folder_ / "made.vdb").string());
    out.setGridStatsMetadataEnabled(false);
    out.write(openvdb::GridPtrVec{g});
    return folder_ / "made.vdb";
  };
  EXPECT_TRUE(volume_read(write("file_voxel_count", openvdb::Int64Metadata(1))).notes.empty());
  for (const fs::path& stale : {write("file_voxel_count", openvdb::Int64Metadata(9047)),
                                write("file_bbox_max", openvdb::Vec3IMetadata({9, 9, 9}))})
    EXPECT_THAT(volume_read(stale).notes, testing::ElementsAre(HasSubstr("1 voxels are active")));
}

TEST_F(VdbRefused, FilesThatAreNoVdb) {
  EXPECT_THAT(refusal(folder_ / "absent.vdb"), HasSubstr("no such file"));
  EXPECT_THAT(refusal(folder_), HasSubstr("not a regular file"));
  EXPECT_THAT(refusal(file("", "empty.vdb")), HasSubstr("is empty"));
  EXPECT_THAT(refusal(file("no volume, but long enough to hold a header", "text.vdb")), HasSubstr("not a VDB file"));
  EXPECT_THAT(refusal(file("x", "volume.xyz")), AllOf(HasSubstr("'.xyz'"), HasSubstr("known: .vdb")));
}

TEST_F(VdbRefused, NoTruncationPasses) {
  const auto g = grid();
  g->fill(CoordBBox(Coord(0), Coord(20)), 0.5f);
  const std::string whole = bytes_of(file({g}));
  for (std::size_t size = 0; size < whole.size(); size += size < 600 ? 31 : whole.size() / 9)
    EXPECT_NE(refusal(file(whole.substr(0, size))), "accepted") << size;
  EXPECT_EQ(refusal(file(whole)), "accepted");

  NEED_DATA(data_path("volumes/smoke.vdb"));
  const std::string smoke = bytes_of(data_path("volumes/smoke.vdb"));
  const std::size_t n = smoke.size();
  for (std::size_t size : {std::size_t{1000}, n / 2, n - 1000, n - 1})
    EXPECT_THAT(refusal(file(smoke.substr(0, size))), Ne("accepted")) << size;
}

// Eight random bytes in the file changed.
TEST_F(VdbRefused, FlippedBytesNeverGiveAnAbsurdGrid) {
  const fs::path original = data_path("volumes/oiio_sphere_fog.vdb");
  NEED_DATA(original);
  const std::string whole = bytes_of(original);
  for (unsigned seed = 0; seed < 24; ++seed) {
    std::mt19937 random(seed);
    std::string flipped = whole;
    for (int i = 0; i < 8; ++i) flipped[random() % flipped.size()] = static_cast<char>(random() % 256);
    const fs::path path = file(flipped);
    if (refusal(path) == "accepted") {
      EXPECT_LE(volume_read(path).stored_bytes(), 1u << 26) << seed;
    }
  }
}

// One byte in the length of a text, and the library asks for 4 GB.
TEST_F(VdbRefused, LengthsThatLieTakeNoMemory) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the memory of a sanitized process is not that of the program";
#endif
  std::string whole = bytes_of(file({grid()}));
  const std::size_t at = whole.find("file_bbox_max");  // its length stands before it
  ASSERT_NE(at, std::string::npos);
  for (const std::size_t byte : {at - 1, at - 2}) {
    std::string flipped = whole;
    flipped[byte] = static_cast<char>(0xf0);
    EXPECT_NE(refusal(file(flipped)), "accepted");
  }
  rusage usage;
  getrusage(RUSAGE_CHILDREN, &usage);
  EXPECT_LT(usage.ru_maxrss, (1 << 20) + (100 << 10)) << "KiB of the largest child process";
}

// Bytes inside of compressed voxels, which OpenVDB trusts: what they do to the reader ends there.
TEST_F(VdbRefused, CrashesOfTheReaderAreOneLine) {
  const std::tuple<const char*, std::size_t, int> cases[] = {{"/scenes/data/plume.vdb", 410597, 160},
                                                             {"/tests/data/mitsuba/fog_grey.vdb", 9408, 127}};
  for (const auto& [name, at, value] : cases) {
    std::string flipped = bytes_of(BRUME_SOURCE_DIR + std::string(name));
    flipped.at(at) = static_cast<char>(value);
    EXPECT_THROW(volume_list(file(flipped), true), InputError) << name;
  }
}

}  // namespace
