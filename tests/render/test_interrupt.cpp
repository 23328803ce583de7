// Ctrl-C wherever the program is, and work that would never end: the real program and real signals.
#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "image/image.hpp"
#include "program.hpp"

namespace brume::test {
namespace {

using testing::HasSubstr;
using Clock = std::chrono::steady_clock;

constexpr const char* SMOKE = R"({
  "camera": {"eye": [1.5, 1, 3], "target": [0, 0, 0], "vfov": 30}, "film": {"size": [512, 512]},
  "lights": [{"type": "directional", "direction": [-0.5, -1, -0.3], "irradiance": [3, 3, 3]},
             {"type": "point", "position": [-0.5, 2, -0.3], "intensity": [3, 3, 3]}],
  "media": [{"density": {"type": "perlin", "resolution": [40, 40, 40], "octaves": 1}, "sigma_a": 0.2, "sigma_s": 5}]})";

constexpr double ANSWER_S = 1.5;  // a second is promised, the rest is for a machine that has other work

class Interrupt : public Program {
 protected:
  struct Ended {
    int exit_code;
    double seconds;  // from the signal to the end
    std::string err;
  };

  // Runs `brume ARGUMENTS`, waits until `ready` or `after_s` are over, then sends SIGINT.
  Ended interrupt(const std::string& arguments, double after_s, const std::string& environment = "") const {
    const fs::path log = fs::path(folder_.string() + ".log");
    const std::string command = "cd " + folder_.string() + " && exec env " + environment + " " BRUME_BINARY " " +
                                arguments + " >/dev/null 2>" + log.string();
    const pid_t child = fork();
    if (child == 0) {
      execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
      _exit(127);
    }
    std::this_thread::sleep_for(std::chrono::duration<double>(after_s));
    const auto start = Clock::now();
    EXPECT_EQ(waitpid(child, nullptr, WNOHANG), 0) << "ended before the signal: " << text(log);
    kill(child, SIGINT);
    int status = 0;
    waitpid(child, &status, 0);
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    Ended ended{WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), seconds, text(log)};
    fs::remove(log);
    return ended;
  }

  void expect_answered(const Ended& ended) const {
    EXPECT_EQ(ended.exit_code, 130) << ended.err;
    EXPECT_LT(ended.seconds, ANSWER_S) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("brume: stopping; once more ends at once\n"));
  }
};

TEST_F(Interrupt, WhileKernelsAreBuilt) {
  write("a.json", SMOKE);
  const Ended ended = interrupt("render a.json -o a.exr", 0.6, "POCL_CACHE_DIR=" + (folder_ / "kernels").string());
  expect_answered(ended);
  EXPECT_FALSE(files().count("a.exr"));
}

TEST_F(Interrupt, WhileADensityIsMade) {
  write("a.json", SMOKE);
  expect_answered(interrupt("render a.json -o a.exr --set /media/0/density/resolution=[700,700,700]", 0.6));
  EXPECT_EQ(files(), std::set<std::string>{"a.json"});
}

TEST_F(Interrupt, WhileLightGridsAreFilled) {
  write("a.json", SMOKE);
  const std::string grid = " --shadow grid --quiet --set /render/light_grid=";
  ASSERT_EQ(run("render a.json -o warm.exr --size 8x8" + grid + "4").exit_code, 0);  // kernels
  expect_answered(
      interrupt("render a.json -o a.exr" + grid + "512 --set /media/0/density/resolution=[200,200,200]", 1.5));
  EXPECT_FALSE(files().count("a.exr"));
}

TEST_F(Interrupt, InTheMiddleOfAPictureKeepsWhatIsDone) {
  write("a.json", SMOKE);
  const std::string dense = "render a.json --spp 64 --quiet -o ";
  ASSERT_EQ(run(dense + "warm.exr --size 8x8").exit_code, 0);
  expect_answered(interrupt(dense + "a.exr", 1.5));
  const Image kept = image_read(folder_ / "a.exr");
  EXPECT_GT(*std::max_element(kept.values.begin(), kept.values.end()), 0);
}

// No batch of such rays ever ends.
TEST_F(Interrupt, WhileTheDeviceDoesNotAnswer) {
  write("a.json", SMOKE);
  const std::string fine = " --method march_midpoint --quiet";
  ASSERT_EQ(run("render a.json -o warm.exr --size 8x8" + fine).exit_code, 0);
  expect_answered(interrupt("render a.json -o a.exr --size 64x64 --step 1e-5" + fine, 1));
  EXPECT_FALSE(files().count("a.exr"));
}

// The rows above the smoke are done, the batch behind them never ends: they are written all the same.
TEST_F(Interrupt, WhatIsDoneIsWrittenWhereTheDeviceDoesNotAnswer) {
  write("a.json", SMOKE);
  const std::string fine = " --method march_midpoint --quiet --set /camera/vfov=100 --set /background=[1,1,1]";
  ASSERT_EQ(run("render a.json -o warm.exr --size 8x8" + fine).exit_code, 0);
  expect_answered(interrupt("render a.json -o a.exr --size 64x64 --step 1e-5" + fine, 1));
  const Image kept = image_read(folder_ / "a.exr");
  EXPECT_EQ(kept.values.front(), 1);
  EXPECT_EQ(kept.values[kept.values.size() / 2], 0);
}

TEST_F(Interrupt, WhileCheckingAndMeasuring) {
  expect_answered(interrupt("check", 1));
  expect_answered(interrupt("check --stability", 1));
  expect_answered(interrupt("bench --filter process", 2, "TMPDIR=" + folder_.string()));
  EXPECT_EQ(files(), std::set<std::string>{});
}

TEST_F(Interrupt, StepsBeyondAnyPictureAreRefused) {
  write("a.json", SMOKE);
  expect_refused(
      "render a.json -o a.exr --method march_midpoint --step 1e-6", 2,
      "/render/step: 1e-06 makes 1e+06 steps along the longest side of a medium; at most 100000 are allowed");
}

// 2^64 rays if all were followed.
TEST_F(Interrupt, MirrorsAndGlassInAWallOfEach) {
  std::string shapes;
  for (int i = 0; i < 9; ++i) {
    const int column = i % 3 - 1, row = i / 3 - 1;
    shapes += std::string(i ? "," : "") + R"({"type": "sphere", "radius": 0.5, "material": ")" +
              (i % 2 ? "glass" : "mirror") + "\", \"center\": [" + std::to_string(1.05 * column) + "," +
              std::to_string(1.05 * row) + ", 0]}";
  }
  write("a.json", R"({"camera": {"eye": [0.3, 0.5, 5], "target": [0, 0, 0], "vfov": 40}, "film": {"size": [64, 64]},
    "background": 0.5, "materials": {"glass": {"reflection": 0.5, "refraction": 0.5, "ior": 1.5},
    "mirror": {"reflection": 0.5, "refraction": 0.5, "ior": 1.2}}, "shapes": [)" +
                      shapes + "]}");
  Outcome deep = run("render a.json -o deep.exr --stats s.json --set /render/max_depth=64", "", "timeout 30");
  ASSERT_EQ(deep.exit_code, 0) << deep.err;
  EXPECT_THAT(deep.err, HasSubstr("reflected and refracted rays were dropped, a sample may send on 4096"));
  const auto rays = nlohmann::json::parse(text(folder_ / "s.json"))["rays"];
  EXPECT_GT(rays["dropped"], 0);
  EXPECT_LE(rays["secondary"], 4096.0 * 64 * 64);
  const Outcome whole = run("render a.json -o whole.exr --stats s.json --set /render/max_depth=11", "", "timeout 30");
  EXPECT_EQ(whole.err.find("dropped"), std::string::npos) << whole.err;
}

}  // namespace
}  // namespace brume::test
