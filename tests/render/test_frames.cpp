// Sequences by the real program: which frames are rendered, kept, left out, and what is told of it.
#include <gmock/gmock.h>

#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "image/image.hpp"
#include "program.hpp"

namespace brume::test {
namespace {

using testing::HasSubstr;
using testing::Not;

// A ball whose texture, of one colour, is another file in every frame, before one that is the same in all.
constexpr const char* SCENE = R"({"film": {"size": [8, 6]}, "ambient": 1, "background": 0.5,
  "materials": {"ball": {"diffuse": 0, "ambient": 1, "texture": "t_%02d.png"},
                "wall": {"diffuse": 0, "ambient": 1, "texture": "wall.png"}},
  "shapes": [{"type": "sphere", "material": "ball"}, {"type": "plane", "normal": [0, 0, 1], "point": [0, 0, -2],
              "material": "wall"}]})";

class Frames : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("film.json", SCENE);
    picture("wall", 0.2);
    for (int frame = 1; frame <= 4; ++frame) picture("t_0" + std::to_string(frame), 0.2 * frame);
  }
  void picture(const std::string& name, double grey) const {
    image_write_display(folder_ / (name + ".png"), 2, 2, std::vector<float>(12, static_cast<float>(grey)));
  }
  nlohmann::json stats(const std::string& name) const { return nlohmann::json::parse(text(folder_ / name)); }
};

TEST_F(Frames, EachIsThePictureOfItsOwnFiles) {
  const Outcome r = run("render film.json --frames 1-4 -o f_%02d.png --stats s.json");
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_EQ(r.out, "f_01.png\nf_02.png\nf_03.png\nf_04.png\n");
  for (int frame = 1; frame <= 4; ++frame) {
    std::string one = SCENE;
    one.replace(one.find("%02d"), 4, "0" + std::to_string(frame));
    write("one.json", one);
    ASSERT_EQ(run("render one.json --quiet -o one.png").exit_code, 0);
    EXPECT_EQ(text(folder_ / ("f_0" + std::to_string(frame) + ".png")), text(folder_ / "one.png")) << frame;
  }
  const nlohmann::json rows = stats("s.json")["frames"];
  ASSERT_EQ(rows.size(), 4u);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(rows[std::size_t(i)]["frame"], i + 1);
    EXPECT_EQ(rows[std::size_t(i)]["state"], "rendered");
    EXPECT_EQ(rows[std::size_t(i)]["rays"]["primary"], 48);
  }
}

TEST_F(Frames, FinishedOnesAreKeptOnARestart) {
  ASSERT_EQ(run("render film.json --frames 2-3 -o f_%d.png --quiet").exit_code, 0);
  write("f_2.png", "as it was");
  const Outcome r = run("render film.json --frames 1-4 -o f_%d.png --stats s.json");
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_EQ(r.out, "f_1.png\nf_4.png\n");
  EXPECT_THAT(r.err, HasSubstr("brume: kept: frames 2-3, whose pictures are there; --overwrite renders them again\n"));
  EXPECT_EQ(text(folder_ / "f_2.png"), "as it was");
  EXPECT_EQ(stats("s.json")["kept"], 2);
  EXPECT_EQ(stats("s.json")["frames"][1]["state"], "kept");
  EXPECT_FALSE(stats("s.json")["frames"][1].contains("render_s"));
  ASSERT_EQ(run("render film.json --frames 1-4 -o f_%d.png --quiet --stats s.json").exit_code, 0);  // what was known
  EXPECT_EQ(stats("s.json")["frames"][0]["state"], "kept");
  EXPECT_GT(stats("s.json")["frames"][0]["render_s"], 0);
  EXPECT_EQ(run("render film.json --frames 1-4 -o f_%d.png --overwrite").out, "f_1.png\nf_2.png\nf_3.png\nf_4.png\n");
  EXPECT_NE(text(folder_ / "f_2.png"), "as it was");
}

TEST_F(Frames, OneOfTwoOutputsIsNotFinished) {
  ASSERT_EQ(run("render film.json --frames 1 -o f_%d.png --quiet").exit_code, 0);
  EXPECT_EQ(run("render film.json --frames 1 -o f_%d.png -o f_%d.jpg").out, "f_1.png\nf_1.jpg\n");
}

TEST_F(Frames, MissingOnesAreNamedBeforeTheFirst) {
  fs::remove(folder_ / "t_02.png");
  fs::remove(folder_ / "t_03.png");
  const Outcome r = run("render film.json --frames 1-4 -o f_%d.png --stats s.json");
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_EQ(r.out, "f_1.png\nf_4.png\n");
  const std::string told =
      "brume: left out, since files are missing: frames 2-3, the first t_02.png: cannot be opened: "
      "No such file or directory\n";
  ASSERT_THAT(r.err, HasSubstr(told));
  EXPECT_LT(r.err.find(told), r.err.find("brume: frame 1, "));
  EXPECT_EQ(stats("s.json")["frames"][2]["state"], "failed");
  const Outcome strict = run("render film.json --frames 1-4 -o g_%d.png --strict");
  EXPECT_EQ(strict.exit_code, 2);
  EXPECT_EQ(strict.out, "");
}

TEST_F(Frames, DamagedOnesAreLeftOut) {
  write("t_02.png", "damaged");
  const Outcome r = run("render film.json --frames 1-4 -o f_%d.png --stats s.json");
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_EQ(r.out, "f_1.png\nf_3.png\nf_4.png\n");
  EXPECT_THAT(r.err, HasSubstr("brume: frame 2 is left out: t_02.png: is not an image of a known format"));
  EXPECT_THAT(std::string(stats("s.json")["frames"][1]["why"]), HasSubstr("t_02.png"));
  const Outcome strict = run("render film.json --frames 1-4 -o g_%d.png --strict");
  EXPECT_EQ(strict.exit_code, 2);
  EXPECT_EQ(strict.out, "g_1.png\n");
  EXPECT_THAT(strict.err, HasSubstr("brume: finished: frame 1; the same command goes on\n"));
}

TEST_F(Frames, MistakesAreOneLine) {
  const std::string names = "names the files of a sequence, expected together with ";
  expect_refused("render film.json -o f.png", 2, names + "brume render --frames");
  expect_refused("render wall.vdb -o f_%d.png", 2, "-o f_%d.png: " + names + "--frames");
  expect_refused("render t_%02d.vdb -o f.png", 2, "t_%02d.vdb: " + names + "--frames");
  expect_refused("render film.json --frames 1-4 -o f.png", 2, "-o f.png: with --frames expected a place");
  expect_refused("render film.json --frames 4-1 -o f_%d.png", 2, "--frames: expected A-B");
  expect_refused("render film.json --frames 7-9 -o f_%d.png", 2, "t_07.png: cannot be opened");
  expect_refused("render film.json --frames 1 -o f_%d.png --resume a.exr", 2, "--resume: expected without --frames");
  expect_refused("render film.json --frames 1 -o f_%d.png --stats s_%d.json", 2, "there is one for all frames");
  write("one.json", "{}");
  expect_refused("render one.json --frames 1-4 -o f_%d.png", 2, "nothing differs from frame to frame");
}

TEST_F(Frames, PicturesNeverReplaceWhatTheyAreMadeOf) {
  expect_refused("render film.json --frames 1-4 -o t_%02d.png --overwrite", 2, "is the same file as the scene's");
}

TEST_F(Frames, WithoutADeviceItEnds) {
  const Outcome r = run("render film.json --frames 1-4 -o f_%d.png --device nosuch", "", "timeout 20");
  EXPECT_EQ(r.exit_code, 2);
  EXPECT_THAT(r.err, HasSubstr("nosuch"));
}

// By the script of scenes/, with the program that is tested.
TEST_F(Frames, AFilmIsMadeWhereFfmpegIs) {
  const std::string film = "cd " + folder_.string() + " && BRUME=" BRUME_BINARY " ",
                    rest = "/bin/bash " BRUME_SOURCE_DIR "/scenes/film film.json 1-4 film.mp4 --quiet >out 2>err";
  EXPECT_NE(std::system((film + "PATH=/nowhere " + rest).c_str()), 0);
  EXPECT_EQ(text(folder_ / "err"), "film: ffmpeg: not there; Debian's package ffmpeg has it\n");
  if (std::system("command -v ffmpeg >/dev/null") != 0) GTEST_SKIP() << "ffmpeg is not installed";
  EXPECT_EQ(std::system((film + rest).c_str()), 0) << text(folder_ / "err");
  EXPECT_EQ(text(folder_ / "out"), "film.mp4: 4 frames, 24 a second\n");
  EXPECT_GT(fs::file_size(folder_ / "film.mp4"), 500u);
}

TEST_F(Frames, AMistakeOfTheSceneEndsIt) {
  const Outcome r = run("render film.json --frames 1-4 -o f_%d.png --crop 100,100,200,200");
  EXPECT_EQ(r.exit_code, 2);
  EXPECT_THAT(r.err, Not(HasSubstr("frame 2")));
}

TEST_F(Frames, CamerasMayDifferFromFrameToFrame) {
  for (int frame = 1; frame <= 2; ++frame)
    write("c_" + std::to_string(frame) + ".json", R"({"eye": [0, 0, )" + std::to_string(2 + frame) + "]}");
  write("still.json", R"({"film": {"size": [8, 6]}, "ambient": 1, "shapes": [{"type": "sphere"}],
                          "lights": [{"type": "directional", "direction": [-1, -1, -1]}]})");
  ASSERT_EQ(run("render still.json --frames 1-2 --camera c_%d.json -o f_%d.png --quiet").exit_code, 0);
  ASSERT_EQ(run("render still.json --set /camera/eye=[0,0,4] -o one.png --quiet").exit_code, 0);
  EXPECT_EQ(text(folder_ / "f_2.png"), text(folder_ / "one.png"));
  EXPECT_NE(text(folder_ / "f_1.png"), text(folder_ / "one.png"));
}

TEST_F(Frames, ACameraIsSavedAndTakenForAnyFile) {
  const std::string tank = (test_data() / "own/tank_06.vdb").string();
  if (!fs::exists(tank)) GTEST_SKIP() << tank << " is not there";
  ASSERT_EQ(run("render " + tank + " -o a.png --size 16x12 --quiet --save-camera c.json --save-scene s.json").exit_code,
            0);
  ASSERT_EQ(run("render s.json -o b.png --quiet --set /camera/eye=[9,9,9] --save-camera far.json").exit_code, 0);
  ASSERT_EQ(run("render s.json -o c.png --quiet --camera c.json").exit_code, 0);
  ASSERT_EQ(run("render " + tank + " -o d.png --size 16x12 --quiet --camera far.json").exit_code, 0);
  EXPECT_EQ(text(folder_ / "a.png"), text(folder_ / "c.png"));
  EXPECT_EQ(text(folder_ / "b.png"), text(folder_ / "d.png"));
  EXPECT_NE(text(folder_ / "a.png"), text(folder_ / "b.png"));
  expect_refused("render s.json -o e.png --camera none.json", 2, "none.json: ");
  expect_refused("render s.json -o e.png --camera c.json --save-camera c.json", 2, "is the same file as --camera");
}

TEST_F(Frames, BareFilesHaveOneCameraForAll) {
  if (!fs::exists(test_data() / "own/tank_06.vdb")) GTEST_SKIP() << test_data() << " holds no own/tank_06.vdb";
  const std::string tank = (test_data() / "own/tank_%02d.vdb").string();
  const Outcome r = run("render " + tank + " --frames 2-6:2 -o f_%02d.png --size 16x12 --save-scene tank.json");
  ASSERT_EQ(r.exit_code, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("brume: for all frames: " + (test_data() / "own/tank_06.vdb").string() + ", grid"));
  EXPECT_EQ(r.out, "f_02.png\nf_04.png\nf_06.png\n");
  ASSERT_EQ(run("render tank.json --frames 4 -o g_%02d.png --quiet").exit_code, 0);
  EXPECT_EQ(text(folder_ / "f_04.png"), text(folder_ / "g_04.png"));
}

TEST_F(Frames, CtrlCKeepsFinishedOnes) {
  const std::string command = "cd " + folder_.string() +
                              " && exec timeout -s INT 1.5 " BRUME_BINARY
                              " render film.json --frames 1-4 -o f_%d.exr --stats s.json --set /film/size=[400,400] "
                              "--spp 256 2>err >out";
  const int status = std::system(command.c_str());
  EXPECT_TRUE(WIFEXITED(status));
  const std::string err = text(folder_ / "err"), out = text(folder_ / "out");
  EXPECT_THAT(err, HasSubstr("finish"));
  EXPECT_THAT(err, HasSubstr("interrupted"));
  const auto lines = std::count(out.begin(), out.end(), '\n');
  EXPECT_LT(lines, 4);
  EXPECT_EQ(stats("s.json")["rendered"], lines);
  for (int frame = 1; frame <= 4; ++frame)  // none that is there is a picture in part
    EXPECT_EQ(files().count("f_" + std::to_string(frame) + ".exr"), frame <= lines ? 1u : 0u);
}

}  // namespace
}  // namespace brume::test
