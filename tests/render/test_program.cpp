// The program as its users run it: outputs, options, determinism, interruption.
#include <nlohmann/json.hpp>

#include <gmock/gmock.h>
#include "film/film_compare.hpp"
#include "image/image.hpp"

#include "program.hpp"

namespace brume::test {
namespace {

using nlohmann::json;

constexpr const char* SCENE = R"({
  "camera": {"eye": [1.5, 1, 3], "target": [0, 0, 0], "vfov": 40}, "film": {"size": [24, 20], "spp": 2},
  "background": [0.1, 0.2, 0.3],
  "lights": [{"type": "directional", "direction": [-0.5, -1, -0.3], "irradiance": [3, 3, 3]}],
  "materials": {"grey": {"diffuse": [0.6, 0.6, 0.6]}},
  "shapes": [{"type": "sphere", "center": [0, -0.5, 0], "radius": 0.4, "material": "grey"}],
  "media": [{"density": {"type": "perlin", "resolution": [12, 12, 12]}, "sigma_a": 0.2, "sigma_s": 1}]})";

class Render : public Program {
 protected:
  Image image(const std::string& name) const { return image_read(folder_ / name); }
  // Same channels, same bits.
  void expect_identical(const std::string& a, const std::string& b) const {
    const Image first = image(a), second = image(b);
    EXPECT_EQ(first.channel_names, second.channel_names);
    EXPECT_TRUE(first.values == second.values) << a << " and " << b << " differ";
  }
};

TEST_F(Render, WritesEveryFormatLayersAndStatistics) {
  write("a.json", SCENE);
  const Outcome r =
      run("render a.json -o a.exr -o a.png -o a.jpg --aov depth,normal,transmittance,cost --stats s.json --quiet");
  ASSERT_EQ(r.exit_code, 0) << r.err;
  EXPECT_EQ(r.err, "");
  EXPECT_EQ(r.out, "a.exr\na.png\na.jpg\n");
  EXPECT_EQ(files(), (std::set<std::string>{"a.json", "a.exr", "a.png", "a.jpg", "s.json"}));
  const Image exr = image("a.exr");
  for (const char* channel :
       {"R", "G", "B", "depth.Z", "normal.X", "normal.Y", "normal.Z", "transmittance.R", "cost.Y"})
    EXPECT_GE(image_channel(exr, channel), 0) << channel;
  EXPECT_EQ(image("a.png").width, 24);
  EXPECT_EQ(image("a.jpg").height, 20);
  const json stats = json::parse(text(folder_ / "s.json"));
  for (const char* key : {"scene", "device", "lanes", "method", "step", "size", "spp", "kernel_build_s", "load_s",
                          "upload_s", "render_s", "total_s", "rays", "lookups", "passes", "memory", "error"})
    EXPECT_TRUE(stats.contains(key)) << key;
  EXPECT_EQ(stats["rays"]["primary"], 24 * 20 * 2);
  EXPECT_GT(stats["lookups"], 0);
}

TEST_F(Render, IsTheSameFromRunToRunForAnyThreadsAndTiles) {
  write("a.json", SCENE);
  ASSERT_EQ(run("render a.json -o a.exr --quiet").exit_code, 0);
  ASSERT_EQ(run("render a.json -o b.exr --quiet", "POCL_MAX_PTHREAD_COUNT=1").exit_code, 0);
  ASSERT_EQ(run("render a.json -o c.exr --quiet --crop 5,3,19,17").exit_code, 0);
  expect_identical("a.exr", "b.exr");
  const Image whole = image("a.exr"), crop = image("c.exr");
  ASSERT_EQ(crop.width, whole.width);
  const auto value = [](const Image& image, int x, int y, const char* channel) {  // a part has more channels
    return image.values[std::size_t((y * image.width + x) * image.channels + image_channel(image, channel))];
  };
  for (int y = 3; y < 17; ++y)
    for (int x = 5; x < 19; ++x)
      for (const char* channel : {"R", "G", "B"})
        ASSERT_EQ(value(whole, x, y, channel), value(crop, x, y, channel)) << x << "," << y;
}

TEST_F(Render, LanesAndGenericKernelsAgree) {
  write("a.json", SCENE);
  ASSERT_EQ(run("render a.json -o a.exr --quiet --lanes 8").exit_code, 0);
  for (const std::string option : {"--lanes 1", "--lanes 4", "--lanes 16", "--generic"}) {
    ASSERT_EQ(run("render a.json -o b.exr --quiet " + option).exit_code, 0);
    EXPECT_LT(image_compare(image("b.exr"), image("a.exr")).rel_rmse, 1e-5) << option;
  }
}

TEST_F(Render, OptionsReachTheScene) {
  write("a.json", SCENE);
  ASSERT_EQ(run("render a.json -o a.exr --quiet --size 10x6 --spp 1 --set /background=[0,0,0] --seed 3").exit_code, 0);
  const Image small = image("a.exr");
  EXPECT_EQ(small.width, 10);
  EXPECT_EQ(small.height, 6);
  ASSERT_EQ(run("render a.json -o b.exr --quiet --size 10x6 --spp 1 --shadow grid --method march_midpoint --step 0.02")
                .exit_code,
            0);
}

TEST_F(Render, NamesTheMethodOfEachMedium) {
  write("a.json", R"({"film": {"size": [8, 8]}, "render": {"method": "march_midpoint", "step": 0.25}, "media": [
    {"density": {"type": "linear", "resolution": [8, 8, 8]}, "sigma_a": 1},
    {"density": {"type": "constant"}, "method": "homogeneous", "step": 0.5, "sigma_a": 1},
    {"density": {"type": "linear", "resolution": [8, 8, 8]}, "method": "dda_midpoint", "sigma_a": 1}]})");
  const Outcome r = run("render a.json -o a.exr --stats s.json --strict");
  ASSERT_EQ(r.exit_code, 0) << r.err;
  const std::string names = "march_midpoint (/media/0), homogeneous (/media/1), dda_midpoint (/media/2)";
  EXPECT_NE(r.err.find("method " + names), std::string::npos) << r.err;
  EXPECT_NE(text(folder_ / "a.exr").find(names), std::string::npos);
  const json stats = json::parse(text(folder_ / "s.json"));
  EXPECT_EQ(stats["method"], names);
  ASSERT_EQ(stats["media"].size(), 3u);
  EXPECT_EQ(stats["media"][1]["method"], "homogeneous");
  EXPECT_EQ(stats["media"][0]["step"], 0.5);  // of a medium 2 long
  EXPECT_EQ(stats["media"][1]["step"], 1.0);
  EXPECT_FALSE(stats["media"][2].contains("step"));
  expect_refused("render a.json -o b.exr --method dda_nearest", 2, "of /media/0; these do: auto, dda_gauss2");
}

TEST_F(Render, BareVolumeSavesTheSceneThatItUsed) {
  const std::string plume = BRUME_SOURCE_DIR "/scenes/data/plume.vdb";
  const Outcome r = run("render " + plume + " -o a.exr --size 16x16 --save-scene s.json");
  ASSERT_EQ(r.exit_code, 0) << r.err;
  EXPECT_NE(r.err.find("tau"), std::string::npos) << r.err;
  ASSERT_EQ(run("render s.json -o b.exr --quiet").exit_code, 0);
  expect_identical("a.exr", "b.exr");
}

TEST_F(Render, ToolsSpeakJson) {
  write("a.json", SCENE);
  ASSERT_EQ(run("render a.json -o a.exr --quiet").exit_code, 0);
  for (const std::string command :
       {"devices --json", "info a.json --json", "info " BRUME_SOURCE_DIR "/scenes/data/plume.vdb --json",
        "info " BRUME_SOURCE_DIR "/scenes/data/lighthouse.obj --json", "compare a.exr a.exr --json"}) {
    const Outcome r = run(command);
    EXPECT_EQ(r.exit_code, 0) << command << r.err;
    EXPECT_TRUE(json::accept(r.out)) << command << "\n" << r.out;
  }
  ASSERT_EQ(run("render a.json -o b.exr --quiet --set /background=[1,1,1]").exit_code, 0);
  EXPECT_EQ(run("compare a.exr b.exr --fail-above 0.001").exit_code, 1);
  EXPECT_EQ(run("compare a.exr a.exr --fail-above 0.001").exit_code, 0);
}

TEST_F(Render, InterruptedKeepsWhatIsDone) {
  write("a.json", SCENE);
  run("render a.json -o a.png --quiet --size 16x16 --spp 4");  // kernels cached: the seconds below go into the picture
  const Outcome r =  // timeout signals the process and then its group: twice, which is once
      run("render a.json -o a.exr --quiet --size 256x256 --spp 65536", "", "timeout --preserve-status -s INT 3");
  EXPECT_EQ(r.exit_code, 130);
  const Image kept = image("a.exr");
  EXPECT_EQ(kept.width, 256);
}

// Runs brume beside a reader of volumes that is a shell script of one line.
std::string with_reader(const std::string& line, const std::string& then) {
  return "timeout -s KILL 60 sh -c 'mkdir b && cp \"$0\" b && printf \"#!/bin/sh\\n" + line +
         "\\n\" >b/brume-volume && chmod +x b/brume-volume && " + then + "'";
}

TEST_F(Render, InterruptedWhileAVolumeIsRead) {
  const Outcome r = run("info " BRUME_SOURCE_DIR "/scenes/data/plume.vdb", "",
                        with_reader("exec sleep 60", "{ b/brume \"$@\" & sleep 0.5; kill -INT $!; wait $!; }"));
  EXPECT_EQ(r.exit_code, 130) << r.err;
}

TEST_F(Render, AReaderThatCrashesIsOneLine) {
  const Outcome r =
      run("info " BRUME_SOURCE_DIR "/scenes/data/plume.vdb", "", with_reader("kill -SEGV \\$\\$", "b/brume \"$@\""));
  EXPECT_EQ(r.exit_code, 2);
  EXPECT_THAT(r.err, testing::EndsWith("plume.vdb: is damaged: the reader ended by signal 11\n"));
}

TEST_F(Render, SecondInterruptEndsAtOnce) {
  write("a.json", SCENE);
  // Its first batch takes minutes: only the second signal ends it.
  const Outcome r =
      run("render a.json -o a.exr --quiet --size 256x256 --set /camera/vfov=5 --step 1e-4 --method march_midpoint", "",
          "timeout -s KILL 60 sh -c '\"$@\" & sleep 2; kill -TERM $!; sleep 1; kill -TERM $!; wait $!' sh");
  EXPECT_EQ(r.exit_code, 130);
  EXPECT_EQ(files(), (std::set<std::string>{"a.json"}));
}

TEST_F(Render, AloneSaysWhatIsMissing) {
  write("a.json", SCENE);
  const Outcome r = run("render a.json -o a.jpg", "", "sh -c 'mkdir b && cp \"$0\" b && b/brume \"$@\"'");
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_THAT(r.err, testing::HasSubstr("images need the program"));
  EXPECT_THAT(r.err, testing::HasSubstr("b/brume-image"));
  EXPECT_FALSE(files().count("a.jpg"));
}

}  // namespace
}  // namespace brume::test
