// OpenVDB files that are refused: no densities, too large, damaged. Reading is done in this process; a crash is a failure.
#include "vdb_fixture.hpp"

#include <cmath>
#include <random>

// OpenVDB loses the nodes that it has read when a damaged file makes it throw: not ours to mend, and the program that reads
// such a file ends. Asked for by the leak sanitizer, if there is one.
extern "C" const char* __lsan_default_suppressions() { return "leak:readTopology\n"; }  // NOLINT

using namespace brume;
using namespace brume::test;
using testing::AllOf;
using testing::HasSubstr;
using testing::Ne;

namespace {

using VdbRefused = Vdb;

TEST_F(VdbRefused, RefusesWhatIsNoDensity) {
  EXPECT_THAT(refusal(file({grid_named("bool", "mask")})), HasSubstr("grid 'mask': holds bool values"));
  EXPECT_THAT(refusal(file({FloatGrid::create()})), HasSubstr("no active voxel"));
  EXPECT_THAT(refusal(file({grid("density", 1.0f, 0.5f)})),
              HasSubstr("grid 'density': has the background 0.5; allowed is 0"));
  const auto level_set = grid();
  level_set->setGridClass(openvdb::GRID_LEVEL_SET);
  EXPECT_THAT(refusal(file({level_set})), HasSubstr("is a level set; allowed"));
  const auto frustum = grid();
  frustum->setTransform(
      openvdb::math::Transform::createFrustumTransform(openvdb::BBoxd({0, 0, 0}, {9, 9, 9}), 0.5, 10));
  EXPECT_THAT(refusal(file({frustum})), AllOf(HasSubstr("NonlinearFrustumMap"), HasSubstr("linear")));
  const auto huge = grid();
  huge->setTransform(openvdb::math::Transform::createLinearTransform(1e200));
  EXPECT_THAT(refusal(file({huge})), HasSubstr("not finite"));
}

TEST_F(VdbRefused, RefusesValuesThatAreNoDensity) {
  for (float bad : {NAN, INFINITY, -INFINITY, -0.5f}) {
    const auto g = grid();
    g->tree().setValueOn(Coord(7, 4, 5), bad);
    g->tree().setValueOn(Coord(8, 4, 5), bad);
    EXPECT_THAT(refusal(file({g})), AllOf(HasSubstr("grid 'density': 2 voxels"), HasSubstr("index [7, 4, 5]"))) << bad;
  }
}

TEST_F(VdbRefused, RefusesGridsThatAskForTooMuch) {
  const auto far = grid();
  far->tree().setValueOn(Coord(2000000000, 2000000000, 2000000000), 1.0f);
  EXPECT_THAT(refusal(file({far})),
              AllOf(HasSubstr("1999999998x1999999997x1999999996"), HasSubstr("allowed are 8589934592")));
  const auto tiles = grid();
  tiles->fill(CoordBBox(Coord(0), Coord(4095)), 1.0f);  // one tile, 2³⁶ samples
  EXPECT_THAT(refusal(file({tiles})), AllOf(HasSubstr("4096x4096x4096"), HasSubstr("needs at least")));
}

TEST_F(VdbRefused, MetadataThatContradictsTheTreeIsDamage) {
  const auto write = [&](const std::string& key, const openvdb::Metadata& value) {
    const auto g = grid();
    g->insertMeta(key, value);
    openvdb::io::File out((folder_ / "made.vdb").string());
    out.setGridStatsMetadataEnabled(false);
    out.write(openvdb::GridPtrVec{g});
    return folder_ / "made.vdb";
  };
  EXPECT_EQ(refusal(write("file_voxel_count", openvdb::Int64Metadata(1))), "accepted");
  EXPECT_THAT(refusal(write("file_voxel_count", openvdb::Int64Metadata(9047))),
              HasSubstr("promises 9047; the file is damaged"));
  EXPECT_THAT(refusal(write("file_bbox_max", openvdb::Vec3IMetadata({9, 9, 9}))), HasSubstr("the file is damaged"));
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
  for (std::size_t size = 0; size < whole.size(); size += size < 600 ? 1 : 37)
    EXPECT_NE(refusal(file(whole.substr(0, size))), "accepted") << size;
  EXPECT_EQ(refusal(file(whole)), "accepted");

  NEED_DATA(data_path("volumes/smoke.vdb"));
  const std::string smoke = bytes_of(data_path("volumes/smoke.vdb"));
  const std::size_t n = smoke.size();
  for (std::size_t size : {std::size_t{0}, std::size_t{10}, std::size_t{100}, std::size_t{1000}, n / 4, n / 2,
                           3 * n / 4, n - 1000, n - 8, n - 1})
    EXPECT_THAT(refusal(file(smoke.substr(0, size))), Ne("accepted")) << size;
}

// Eight random bytes in the file changed. What still passes must be of the size that the file says.
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
      EXPECT_EQ(volume_read(path).size(), ivec3(25)) << seed;
    }
  }
}

}  // namespace
