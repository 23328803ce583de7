// Files of instances: 12 numbers a line; what is wrong is told with its line.
#include "mesh/placements.hpp"

#include <glm/vec4.hpp>

#include "unit/mesh/obj_fixture.hpp"

namespace brume::test {
namespace {

using testing::HasSubstr;

class Placements : public Obj {
 protected:
  std::string told(const std::string& text) const {
    try {
      placements_read(write(text, "herd.txt"));
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::StartsWith((folder_ / "herd.txt").string() + ": "));
      return error.what();
    }
    return "accepted";
  }
};

TEST_F(Placements, AreRowsOfMatrices) {
  const auto read = placements_read(
      write("# a herd\n\n1 0 0 5\t0 2 0 -6 0 0 3 7 # the first\r\n0 -1 0 0 1 0 0 0 0 0 1 1e-3", "herd.txt"));
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0] * glm::dvec4(1, 1, 1, 1), glm::dvec3(6, -4, 10));
  EXPECT_EQ(read[1] * glm::dvec4(1, 2, 3, 1), glm::dvec3(-2, 1, 3.001));
}

TEST_F(Placements, WhatIsNoMatrixIsToldWithItsLine) {
  EXPECT_THAT(told("# none\n\n"), HasSubstr("holds no instance: expected 12 numbers a line"));
  EXPECT_THAT(told("1 0 0 0 0 1 0 0 0 0 1 0\n\n1 0 0 0 0 1 0 0 0 0 1\n"), HasSubstr("line 3: expected 12 numbers"));
  EXPECT_THAT(told("1 0 0 0 0 1 0 0 0 0 1 0 1\n"), HasSubstr("line 1: expected 12 numbers"));
  EXPECT_THAT(told("1 0 0 0 0 1 0 0 0 0 1 x\n"), HasSubstr("line 1: 'x' is no number"));
  EXPECT_THAT(told("1 0 0 nan 0 1 0 0 0 0 1 0\n"), HasSubstr("line 1: 'nan' is no number"));
  EXPECT_THAT(told("1e300 0 0 0 0 1 0 0 0 0 1 0\n"), HasSubstr("line 1: '1e300' is no number up to 1e38"));
  EXPECT_THROW(placements_read(folder_ / "nowhere.txt"), InputError);
}

TEST_F(Placements, SingularOnesAreRefusedByTheirNumber) {
  const std::string good = "1 0 0 0 0 1 0 0 0 0 1 0\n";
  EXPECT_THAT(told(good + good + "1 0 0 0 0 1 0 0 0 0 0 0\n"),
              HasSubstr("line 3: instance 2: the transform is singular"));
  EXPECT_THAT(told("1 2 3 0 2 4 6 0 0 0 1 0\n"), HasSubstr("line 1: instance 0: the transform is singular"));
  EXPECT_EQ(told("1e-20 0 0 0 0 1e20 0 0 0 0 1 0\n"), "accepted");
}

}  // namespace
}  // namespace brume::test
