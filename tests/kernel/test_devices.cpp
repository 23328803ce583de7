// The kernels on other OpenCL implementations, in child processes: rusticl on llvmpipe, and Oclgrind, which watches
// every access. A device that is not installed is skipped by name; PoCL is never skipped (test_check.cpp).
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <string>

namespace brume {
namespace {

struct Ended {
  int code;
  std::string text;  // both streams
};

Ended run(const std::string& command) {
  Ended ended{-1, ""};
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (!pipe) return ended;
  char part[4096];
  while (const std::size_t n = fread(part, 1, sizeof part, pipe)) ended.text.append(part, n);
  const int status = pclose(pipe);
  ended.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return ended;
}

bool has(const std::string& environment, const std::string& device) {
  return run("env " + environment + " " BRUME_BINARY " devices").text.find(device) != std::string::npos;
}

void expect_passes(const std::string& command) {
  const Ended ended = run(command);
  EXPECT_EQ(ended.code, 0) << command << "\n" << ended.text;
  EXPECT_NE(ended.text.find(" 0 missed"), std::string::npos) << ended.text;
}

TEST(Devices, RusticlAgreesWithTheReference) {
  if (!has("RUSTICL_ENABLE=llvmpipe", "llvmpipe")) GTEST_SKIP() << "no rusticl on llvmpipe (package mesa-opencl-icd)";
  expect_passes("RUSTICL_ENABLE=llvmpipe timeout 300 " BRUME_BINARY
                " check --device llvmpipe --size 8 --lanes 4 --filter image/fog_gauss2");
}

// One row of each kind: Mesa 22.3 takes half a minute to compile for one, ten and more for a liquid in fog. Three media
// of which some are adaptive take it five minutes at four lanes, half of that at one, which is what the device has by
// itself. Instances come out wrong there for W rays at once, as it warns itself, and right for one.
TEST(Devices, LongRusticlAgreesInScenesOfEveryKind) {
  if (!has("RUSTICL_ENABLE=llvmpipe", "llvmpipe")) GTEST_SKIP() << "no rusticl on llvmpipe (package mesa-opencl-icd)";
  for (const char* row :
       {"4 --filter image/surfaces", "4 --filter image/mirrors_deep", "4 --filter image/area_lights",
        "4 --filter image/occlusion", "4 --filter image/fog_two", "4 --filter image/fog_grid",
        "4 --filter image/fog_ratio", "4 --filter image/adaptive_grid", "1 --filter image/adaptive_media",
        "4 --filter image/glass", "4 --filter image/liquid_box", "1 --filter image/instances"})
    expect_passes("RUSTICL_ENABLE=llvmpipe timeout 300 " BRUME_BINARY " check --device llvmpipe --size 8 --lanes " +
                  std::string(row));
}

// Its compiler emits intrinsics that it does not know itself unless it leaves the code as it is.
std::string oclgrind(const std::string& filter) {
  return "timeout 600 oclgrind --data-races --uninitialized --check-api --build-options -cl-opt-disable " BRUME_BINARY
         " check --device oclgrind --size 4 --lanes 1 --filter " +
         filter;
}

class Oclgrind : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (run("oclgrind --version").code != 0) GTEST_SKIP() << "no oclgrind (package oclgrind)";
  }
};

TEST_P(Oclgrind, ReportsNothing) {
  const Ended ended = run(oclgrind(GetParam()));
  EXPECT_EQ(ended.code, 0) << ended.text;
  for (const char* report :
       {"Invalid read", "Invalid write", "Uninitialized", "data race", "Oclgrind - OpenCL runtime error"})
    EXPECT_EQ(ended.text.find(report), std::string::npos) << ended.text;
}

INSTANTIATE_TEST_SUITE_P(Scenes, Oclgrind,
                         testing::Values("image/fog_midpoint", "image/fog_grid_color", "image/fog_on_one_spot",
                                         "image/adaptive_faint", "image/surfaces", "image/shapes", "image/liquid_fog"),
                         [](const auto& scene) { return std::string(scene.param).substr(6); });

}  // namespace
}  // namespace brume
