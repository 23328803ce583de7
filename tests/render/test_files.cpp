// What becomes of files and streams when something is in the way: a full disk, a closed pipe, a kill.
#include <gmock/gmock.h>
#include <sys/mount.h>

#include "program.hpp"

namespace brume::test {
namespace {

using testing::HasSubstr;

constexpr const char* SCENE = R"({"film": {"size": [64, 64]}, "background": [0.1, 0.2, 0.3],
  "materials": {"a": {"diffuse": 0.1}, "b": {"diffuse": 0.1}, "c": {"diffuse": 0.1}, "d": {"diffuse": 0.1}},
  "shapes": [{"type": "sphere", "center": [0, 0, 0], "radius": 1}, {"type": "sphere", "center": [1, 0, 0], "radius": 1}], "camera": {"eye": [0, 0, 5], "target": [0, 0, 0]},
  "lights": [{"type": "directional", "direction": [0, -1, -1], "irradiance": 3}]})";

class Files : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("a.json", SCENE);
  }
  // Runs with its streams as `streams` says ("</dev/null >&-") and returns the exit code; what it says is in the file
  // err.
  int run_streams(const std::string& arguments, const std::string& streams) const {
    const std::string command =
        "cd " + folder_.string() + " && { timeout 60 " BRUME_BINARY " " + arguments + " 2>err; } " + streams;
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
};

// (Where nothing may be mounted, tests of AtomicFile and Image do the same under a limit on the size of files.)
TEST_F(Files, AFullDiskIsToldAndWhatElseIsDoneIsWritten) {
  const fs::path disk = folder_ / "disk";
  fs::create_directory(disk);
  if (::mount("none", disk.c_str(), "tmpfs", 0, "size=32k") != 0) GTEST_SKIP() << "may not mount a small disk";
  const std::vector<std::string> names = {"a.exr", "a.png", "a.jpg", "s.json"};
  std::string options, said;
  for (const std::string& name : names) {
    write("disk/" + name, "old");
    options += (name == "s.json" ? " --stats disk/" : " -o disk/") + name;
    said += (said.empty() ? "brume: disk/" : "; disk/") + name + ": cannot be written: No space left on device";
  }
  write("disk/fill", std::string(1 << 20, 'x'));
  const Outcome r = run("render a.json --quiet -o c.png" + options);
  const Outcome save = run("render a.json --quiet -o d.png --save-scene disk/s.json");
  std::size_t entries = 0;
  for (const auto& entry : fs::directory_iterator(disk)) entries += entry.is_regular_file();
  for (const std::string& name : names) EXPECT_EQ(text(disk / name), "old") << name;
  ::umount(disk.c_str());
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_EQ(r.err, said + "\n");
  EXPECT_EQ(r.out, "c.png\n");
  EXPECT_EQ(save.exit_code, 1);
  EXPECT_EQ(save.err, "brume: disk/s.json: cannot be written: No space left on device\n");
  EXPECT_EQ(entries, names.size() + 1);  // and "fill": no temporary
}

TEST_F(Files, OfOneRunAreDifferentFiles) {
  fs::create_symlink("a.png", folder_ / "link.png");
  fs::create_directory(folder_ / "sub");
  for (const char* outputs :
       {"-o a.png --stats a.png", "-o a.png --stats sub/../a.png", "-o a.png -o ./a.png", "-o link.png -o a.png",
        "-o a.png --save-scene a.png", "-o a.png --stats a.json", "-o a.png --save-scene sub/../a.json"})
    expect_refused(std::string("render a.json ") + outputs, 2, "is the same file as");
  run("render a.json -o a.png -o b.png --quiet");
  expect_refused("compare a.png b.png -o ./b.png", 2, "is the same file as the reference b.png");
}

TEST_F(Files, StreamsThatAreClosedTakeNothingAndHarmNothing) {
  for (const char* closed : {"<&-", ">&-", "2>&-", "<&- >&- 2>&-"}) {
    EXPECT_EQ(run_streams("render a.json -o a.png -o a.exr --set /film/spp=2", closed), 0) << closed;
    EXPECT_EQ(run("compare a.png a.exr").exit_code, 0) << closed;
  }
}

TEST_F(Files, ResultsThatCannotBePrintedAreAFailure) {
  run("render a.json -o a.png --quiet");
  for (const char* command :
       {"render a.json -o b.png --quiet", "info a.json", "info a.json --json", "devices", "devices --json",
        "compare a.png a.png", "check --filter layout --lanes 1", "--help", "render --help", "--version"}) {
    EXPECT_EQ(run_streams(command, ">/dev/full"), 1) << command;
    EXPECT_THAT(text(folder_ / "err"), testing::StartsWith("brume: standard output: cannot be written")) << command;
  }
  const int status = run_streams("info a.json", "| true; exit $PIPESTATUS");
  EXPECT_TRUE(status == 0 || status == 1);  // by chance whether the reader is gone already
  EXPECT_TRUE(fs::exists(folder_ / "b.png"));
}

TEST_F(Files, AreLeftAloneAfterASignalBeforeMain) {
  const Outcome r = run("render a.json -o b.png", "LD_PRELOAD=" BRUME_EARLY_SIGNAL, "");
  EXPECT_EQ(r.exit_code, 130);
  EXPECT_THAT(r.err, testing::HasSubstr("brume: interrupted"));
  EXPECT_EQ(files(), std::set<std::string>{"a.json"});
}

TEST_F(Files, ThatCannotBeWrittenAreKnownBeforeTheWork) {
  for (const char* command : {"check --json none/c.json", "check --stability --json none/c.json",
                              "render a.json -o b.png --stats none/s.json"})
    expect_refused(command, 1, "the folder 'none' does not exist");
}

TEST_F(Files, AreOfAKindByTheirEnding) {
  fs::copy(folder_ / "a.json", folder_ / "UPPER.JSON");
  EXPECT_EQ(run("render UPPER.JSON -o a.PNG --quiet").exit_code, 0);
  EXPECT_EQ(run("info UPPER.JSON").exit_code, 0);
  write("a.nrrd", "NRRD0004");
  fs::create_directory(folder_ / "folder");
  for (const std::string command : {"render ", "info "}) {
    expect_refused(command + "a.nrrd", 2, "a.nrrd: unknown kind of file '.nrrd'; known: .json, .vdb, .obj");
    expect_refused(command + "none.nrrd", 2, "none.nrrd: cannot be opened: No such file");
    expect_refused(command + "folder", 2, "folder: is a folder, expected a file of a known kind: .json, .vdb, .obj");
  }
}

// A name in Latin-1: printed as it is where it is a result, and as something printable everywhere else.
TEST_F(Files, WhoseNamesAreNotUtf8AreNamed) {
  fs::copy(folder_ / "a.json", folder_ / "n\xE4.json");
  const Outcome r = run("render n\xE4.json -o p\xE4.exr --stats s.json --quiet");
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_EQ(r.out, "p\xE4.exr\n");
  EXPECT_THAT(text(folder_ / "s.json"), HasSubstr("\"n\xEF\xBF\xBD.json\""));
  EXPECT_THAT(run("info n\xE4.json --json").out, HasSubstr("\"n\xEF\xBF\xBD.json\""));
  EXPECT_THAT(run("info n\xE4.json").out, HasSubstr("n\\xE4.json"));
  expect_refused("info x\xE4.json", 2, "x\\xE4.json: cannot be opened");
}

}  // namespace
}  // namespace brume::test
