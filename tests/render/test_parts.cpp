// Pictures made in parts by the real program: joined, gone on from, refused.
#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>

#include "image/image.hpp"
#include "program.hpp"

namespace brume::test {
namespace {

using testing::HasSubstr;

// Noise in all planes: a cloud, a ball and a triangle under two lights, 8 samples of 12 x 8 pixels.
constexpr const char* SCENE = R"({"film": {"size": [12, 8], "spp": 8, "exposure": 1}, "background": [0.5, 0.25, 0.125],
  "camera": {"eye": [1.5, 1, 3], "target": [0, 0, 0], "vfov": 40},
  "lights": [{"type": "directional", "direction": [-0.5, -1, -0.3], "irradiance": [3, 3, 3]},
             {"type": "point", "position": [-0.5, 2, -0.3], "intensity": [3, 2, 1]}],
  "shapes": [{"type": "sphere", "center": [0.5, 0.3, 0], "radius": 0.4},
             {"type": "triangle", "vertices": [[-1, -0.5, -1], [1, -0.5, -1], [0, -0.5, 1]]}],
  "media": [{"density": {"type": "perlin", "resolution": [16, 16, 16]}, "sigma_a": [0.2, 0.3, 0.4], "sigma_s": 5}]})";

class Parts : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("a.json", SCENE);
  }
  void render(const std::string& options) const {
    const Outcome r = run("render a.json --quiet " + options);
    EXPECT_EQ(r.exit_code, 0) << options << "\n" << r.err;
  }
  std::string merge(const std::string& options) const {
    const Outcome r = run("merge " + options);
    EXPECT_EQ(r.exit_code, 0) << options << "\n" << r.err;
    return r.err;
  }
  // The channels of `b` are in `a`, bit for bit; or to rounding.
  void expect_same(const std::string& a, const std::string& b, double rounding = 0) const {
    const Image x = image_read(folder_ / a), y = image_read(folder_ / b);
    ASSERT_EQ(x.width, y.width);
    ASSERT_EQ(x.height, y.height);
    double differing = 0;
    for (std::size_t c = 0; c < y.channel_names.size(); ++c) {
      const int other = image_channel(x, y.channel_names[c]);
      ASSERT_GE(other, 0) << y.channel_names[c];
      for (std::size_t i = 0; i < std::size_t(y.width) * std::size_t(y.height); ++i) {
        const float p = x.values[i * std::size_t(x.channels) + std::size_t(other)],
                    q = y.values[i * std::size_t(y.channels) + c];
        if (std::memcmp(&p, &q, sizeof p) != 0 && !(std::abs(p - q) <= rounding * (std::abs(q) + 0.01))) ++differing;
      }
    }
    EXPECT_EQ(differing, 0) << a << " and " << b;
  }
};

constexpr const char* PLANES = " --aov depth,normal,transmittance,cost,variance,samples";

TEST_F(Parts, CropsJoinToTheBitsOfTheWhole) {
  render("-o whole.exr -o whole.png" + std::string(PLANES));
  render("--crop 0,0,5,8 -o left.exr");
  render("--crop 5,0,12,3 -o top.exr");
  render("--crop 5,3,12,8 -o rest.exr");
  const std::string one = merge("left.exr rest.exr -o two.exr");
  EXPECT_THAT(one, HasSubstr("brume: note: 21 of 96 pixels are missing, the first 5,0\n"));
  EXPECT_EQ(merge("two.exr top.exr -o joined.exr -o joined.png" + std::string(PLANES)), "");
  expect_same("joined.exr", "whole.exr");
  EXPECT_EQ(text(folder_ / "joined.png"), text(folder_ / "whole.png"));  // the render's exposure
}

TEST_F(Parts, SamplesJoinToRounding) {
  render("-o whole.exr" + std::string(PLANES));
  render("--samples 0-3 -o early.exr");
  render("--samples 6-7 -o late.exr");
  render("--samples 4-5 -o middle.exr");
  EXPECT_THAT(merge("late.exr early.exr -o gap.exr"),
              HasSubstr("note: 192 samples are missing in 96 other pixels, the first 4-5 of 0,0\n"));
  EXPECT_EQ(merge("gap.exr middle.exr -o joined.exr" + std::string(PLANES)), "");
  expect_same("joined.exr", "whole.exr", 1e-5);
}

TEST_F(Parts, WhatDoesNotBelongTogetherIsRefusedByName) {
  render("--crop 0,0,5,8 -o a.exr");
  render("--crop 4,2,12,8 --samples 2-3 -o over.exr --lanes 1");  // another BVH is no other scene
  render("--crop 6,0,12,8 -o seed.exr --seed 5");
  render("--crop 6,0,12,8 -o spp.exr --spp 4");
  render("--crop 6,0,12,8 -o size.exr --size 13x8");
  render("--crop 6,0,12,8 -o scene.exr --set /lights/0/irradiance=2");
  render("-o plain.exr");
  const auto refused = [&](const std::string& part, const std::string& cause) {
    expect_refused("merge a.exr " + part + " -o b.exr -o b.png", 2, cause);
  };
  refused("over.exr", "over.exr: overlaps a.exr: both hold sample 2 of pixel 4,2");
  refused("seed.exr", "seed.exr: is no part of the picture of a.exr: brume:seed is 5 and not 0");
  refused("spp.exr", "spp.exr: is no part of the picture of a.exr: brume:spp is 4 and not 8");
  refused("size.exr", "size.exr: is no part of the picture of a.exr: brume:size is 13x8 and not 12x8");
  refused("scene.exr", "scene.exr: is no part of the picture of a.exr: brume:scene_hash is ");
  refused("plain.exr", "plain.exr: is no partial picture to go on from: it has no attribute");
  refused("a.json", "a.json");
  refused("none.exr", "none.exr");
  const std::string whole = text(folder_ / "a.exr");
  write("cut.exr", whole.substr(0, whole.size() / 2));
  refused("cut.exr", "cut.exr: cannot be read");
  expect_refused("merge a.exr over.exr -o a.exr", 2, "is the same file as the part");
  for (const std::string other : {"seed.exr", "size.exr", "scene.exr", "plain.exr", "cut.exr"})
    expect_refused("render a.json -o b.png --quiet --resume " + other, 2, other + ": ");
}

TEST_F(Parts, OptionsThatMakeNoPartAreRefused) {
  expect_refused("render a.json -o b.exr --samples 3-8", 2, "--samples: the samples of a pixel are 0 to 7, got '3-8'");
  expect_refused("render a.json -o b.exr --samples 3", 2, "--samples: expected A-B");
  expect_refused("render a.json -o b.png --partial", 2, "--partial: expected an output of type .exr");
  expect_refused("render a.json -o b.exr --partial --crop 0,0,2,2 --trim", 2, "--partial: a picture cut out by --trim");
  expect_refused("render a.json -o b.exr --partial --size 16000x9000", 2, "--partial: 16000 x 9000");
}

TEST_F(Parts, OnlyPartialFilesHoldSums) {
  const auto holds = [&](const std::string& options, const std::string& file = "b.exr") {
    render(options + " -o " + file);
    return image_channel(image_read(folder_ / file), "brume.samples") >= 0;
  };
  EXPECT_FALSE(holds(""));
  EXPECT_TRUE(holds("--partial"));
  EXPECT_TRUE(holds("--samples 0-1"));
  EXPECT_TRUE(holds("--crop 0,0,3,3"));
  EXPECT_FALSE(holds("--crop 0,0,3,3 --trim"));
  EXPECT_FALSE(holds("--samples 0-1", "b.png"));
}

TEST_F(Parts, ResumeGoesOnToMoreSamples) {
  render("--spp 3 -o a.exr --partial");
  render("--resume a.exr -o b.exr --partial --stats s.json");  // 8 samples
  EXPECT_THAT(text(folder_ / "s.json"), HasSubstr("\"primary\": " + std::to_string(12 * 8 * 5) + ".0"));
  render("-o whole.exr --partial");
  expect_same("b.exr", "whole.exr");
  EXPECT_EQ(merge("b.exr -o c.exr"), "");  // nothing is missing of 8
  expect_refused("render a.json -o c.exr --spp 2 --resume a.exr", 2, "brume:spp is 3 and not 2");
  render("--spp 1 -o centre.exr --partial");
  expect_refused("render a.json -o c.exr --resume centre.exr", 2, "brume:spp is 1 and not 8");
}

TEST_F(Parts, ResumeRendersOnlyWhatIsMissing) {
  render("-o whole.exr" + std::string(PLANES));
  render("--crop 0,0,5,8 -o a.exr");
  const auto rays = [&] {
    const std::string stats = text(folder_ / "s.json"), key = "\"primary\": ";
    return std::stod(stats.substr(stats.find(key) + key.size()));
  };
  render("--resume a.exr -o b.exr --stats s.json" + std::string(PLANES));
  expect_same("b.exr", "whole.exr");
  EXPECT_EQ(rays(), 7 * 8 * 8);
  EXPECT_LT(image_channel(image_read(folder_ / "b.exr"), "brume.samples"), 0);
  render("--resume a.exr --samples 0-2 -o a.exr --stats s.json");  // onto itself
  EXPECT_EQ(rays(), 7 * 8 * 3);
  render("--resume a.exr -o c.exr --partial --stats s.json" + std::string(PLANES));
  EXPECT_EQ(rays(), 7 * 8 * 5);
  expect_same("c.exr", "whole.exr", 1e-5);
  render("--resume c.exr -o d.exr --stats s.json" + std::string(PLANES));
  EXPECT_EQ(rays(), 0);
  expect_same("d.exr", "whole.exr", 1e-5);
}

// Interrupted and gone on from until it is done: the picture of one go.
TEST_F(Parts, WhatCtrlCLeavesIsGoneOnFrom) {
  const std::string options = "--size 96x64 --spp 64 -o i.exr";
  render("--size 96x64 --spp 64 -o whole.exr");
  const fs::path log = fs::path(folder_.string() + ".err");
  const auto interrupted = [&](const std::string& more, double after_s) {
    const std::string command = "cd " + folder_.string() + " && exec " BRUME_BINARY " render a.json --quiet " +
                                options + more + " >/dev/null 2>" + log.string();
    const pid_t child = fork();
    if (child == 0) {
      execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
      _exit(127);
    }
    std::this_thread::sleep_for(std::chrono::duration<double>(after_s));
    kill(child, SIGINT);
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) == 130;
  };
  int times = 0;
  for (double after_s = 0.4; after_s < 5 && !fs::exists(folder_ / "i.exr"); after_s *= 1.3)
    times += interrupted("", after_s);
  ASSERT_TRUE(fs::exists(folder_ / "i.exr"));
  ASSERT_GT(times, 0);
  EXPECT_THAT(text(log), HasSubstr("; the same command with --resume i.exr goes on\n"));
  EXPECT_THAT(merge("i.exr -o half.png"), HasSubstr("pixels are missing"));
  render(options + " --resume i.exr");
  fs::remove(log);
  expect_same("i.exr", "whole.exr");
}

}  // namespace
}  // namespace brume::test
