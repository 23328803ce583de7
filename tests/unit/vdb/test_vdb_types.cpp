// OpenVDB files: the value types that can be densities. Apart from the rest because every type takes seconds to
// compile.
#include "unit/vdb/vdb_fixture.hpp"

using namespace brume;
using namespace brume::test;
using testing::HasSubstr;

namespace {

using VdbTypes = Vdb;

TEST_F(VdbTypes, ReadsEveryScalarType) {
  EXPECT_EQ(volume_read(file({grid<FloatGrid>("a", 0.1f)})).at({0, 0, 0}), 0.1f);
  EXPECT_EQ(volume_read(file({grid<openvdb::DoubleGrid>("a", 0.1)})).at({0, 0, 0}), 0.1f);
  EXPECT_EQ(volume_read(file({grid<openvdb::Int32Grid>("a", 7)})).at({0, 0, 0}), 7.0f);
  EXPECT_EQ(volume_read(file({grid<openvdb::Int64Grid>("a", 9)})).at({0, 0, 0}), 9.0f);
  const auto half = grid<FloatGrid>("a", 0.1f);
  half->setSaveFloatAsHalf(true);
  EXPECT_EQ(volume_read(file({half})).at({0, 0, 0}), 0.0999755859375f);  // nearest 16-bit float
}

TEST_F(VdbTypes, MasksAreZeroAndOne) {
  const auto flags = grid<openvdb::BoolGrid>("a", true, false);
  flags->tree().setValueOn(Coord(4, 4, 5), false);
  const Grid read = volume_read(file({flags}));
  EXPECT_EQ(read.size(), ivec3(2, 1, 1));
  EXPECT_EQ(read.at({0, 0, 0}), 1.0f);
  EXPECT_EQ(read.at({1, 0, 0}), 0.0f);
  const auto mask = openvdb::MaskGrid::create();
  mask->setName("a");
  mask->tree().setValueOn(Coord(3, 4, 5));
  EXPECT_EQ(volume_read(file({mask})).at({0, 0, 0}), 1.0f);
}

TEST_F(VdbTypes, RefusesDoublesThatNoFloatHolds) {
  EXPECT_THAT(refusal(file({grid<openvdb::DoubleGrid>("big", 1e300)})), HasSubstr("grid 'big': 1 voxels"));
}

}  // namespace
