// OpenVDB files: the value types that can be densities. Apart from the rest because every type takes seconds to compile.
#include "vdb_fixture.hpp"

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

TEST_F(VdbTypes, RefusesDoublesThatNoFloatHolds) {
  EXPECT_THAT(refusal(file({grid<openvdb::DoubleGrid>("big", 1e300)})), HasSubstr("grid 'big': 1 voxels"));
}

}  // namespace
