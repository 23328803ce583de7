// What brume sets of the driver's environment, and what it leaves to whoever has set it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

#include "base/cores.hpp"
#include "cl/driver_guard.hpp"
#include "unit/base/one_core.hpp"

namespace brume {
namespace {

constexpr const char* AFFINITY = "POCL_AFFINITY";
constexpr const char* THREADS = "POCL_MAX_PTHREAD_COUNT";

class DriverEnvironment : public testing::Test {
 protected:
  void SetUp() override { clear(); }
  void TearDown() override { clear(); }
  static void clear() {
    ::unsetenv(AFFINITY);
    ::unsetenv(THREADS);
  }
  static std::string affinity() {
    driver_environment();
    const char* value = std::getenv(AFFINITY);
    return value ? value : "none";
  }
};

TEST_F(DriverEnvironment, ThreadsStayOnTheirCoresWhereAllMayBeUsed) {
  EXPECT_EQ(affinity(), cores_are_all_usable() ? "1" : "none");
}

TEST_F(DriverEnvironment, OfFewerThreadsTheSystemFindsTheCores) {
  ::setenv(THREADS, "1", 1);
  EXPECT_EQ(affinity(), "none");
}

TEST_F(DriverEnvironment, LeavesWhatIsSet) {
  ::setenv(AFFINITY, "0", 1);
  EXPECT_EQ(affinity(), "0");
}

TEST_F(DriverEnvironment, KeepsToTheCoresThatAProcessMayUse) {
  if (::sysconf(_SC_NPROCESSORS_CONF) < 2) GTEST_SKIP() << "one core is all there are";
  on_one_core([] { EXPECT_EQ(affinity(), "none"); });
}

}  // namespace
}  // namespace brume
