// How many cores a process may use, by its affinity and by the quota of its control group.
#include <gtest/gtest.h>

#include "base/cores.hpp"
#include "unit/base/one_core.hpp"

namespace brume {
namespace {

TEST(Cores, FollowAQuotaDownToOne) {
  EXPECT_EQ(cores_of_quota("max 100000", 8), 8);
  EXPECT_EQ(cores_of_quota("", 8), 8);  // no such file
  EXPECT_EQ(cores_of_quota("200000 100000", 8), 2);
  EXPECT_EQ(cores_of_quota("160000 100000", 8), 2);
  EXPECT_EQ(cores_of_quota("20000 100000", 8), 1);
  EXPECT_EQ(cores_of_quota("90000000 100000", 8), 8);
  EXPECT_EQ(cores_of_quota("100000 0", 8), 8);
}

TEST(Cores, AreThoseOfTheAffinity) {
  EXPECT_GE(cores_usable(), 1);
  on_one_core([] { EXPECT_EQ(cores_usable(), 1); });
}

}  // namespace
}  // namespace brume
