// PoCL's kernel cache, damaged in every way: the program ends with a picture or a sentence, never by a signal.
#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/cores.hpp"
#include "program.hpp"

namespace brume::test {
namespace {

using testing::HasSubstr;

constexpr const char* BALL =
    R"({"film": {"size": [8, 8]}, "camera": {"eye": [0, 0, 4], "target": [0, 0, 0]}, "background": 0.5,
  "shapes": [{"type": "sphere", "center": [0, 0, 0], "radius": 1, "material": "m"}], "materials": {"m": {"diffuse": 0.5}}})";

class KernelCache : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("a.json", BALL);
    ASSERT_EQ(run("render a.json -o good.exr --quiet", cache()).exit_code, 0);
  }
  static std::string cache() { return "POCL_CACHE_DIR=kernels"; }

  std::ptrdiff_t kept_programs() const {
    return std::distance(fs::directory_iterator(folder_ / "kernels/brume"), fs::directory_iterator());
  }

  // Files whose name ends like this keep `share` of their bytes, the rest becomes zeros or is cut off.
  void damage(const std::string& folder, const std::string& ending, double share, bool cut) const {
    int count = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / folder)) {
      const fs::path& file = entry.path();
      if (!entry.is_regular_file() || file.extension() != ending) continue;
      std::string bytes = text(file);
      const auto keep = static_cast<std::size_t>(share * static_cast<double>(bytes.size()));
      if (cut) {
        bytes.resize(keep);
      } else {
        std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(keep), bytes.end(), '\0');
      }
      fs::remove(file);
      std::ofstream(file, std::ios::binary) << bytes;
      ++count;
    }
    ASSERT_GT(count, 0);
  }

  void expect_mended() const {
    const Outcome r = run("render a.json -o a.exr --quiet", cache());
    EXPECT_EQ(r.exit_code, 0) << r.err;
    EXPECT_THAT(r.err, HasSubstr("starting again with a new one in kernels-fresh; delete kernels\n"));
    EXPECT_EQ(run("compare a.exr good.exr --fail-above 0").exit_code, 0);
  }
};

TEST_F(KernelCache, HalfACompiledKernelIsBuiltAgain) {
  damage("kernels", ".so", 0.5, true);
  expect_mended();
  damage("kernels", ".so", 0, true);
  expect_mended();  // from the fresh cache
}

TEST_F(KernelCache, AGarbledProgramIsBuiltAgain) {
  damage("kernels", ".bc", 0.5, false);
  expect_mended();
  damage("kernels", ".bc", 0, true);
  expect_mended();
}

TEST_F(KernelCache, TwoDamagedCachesAreNamed) {
  damage("kernels", ".so", 0.5, true);
  expect_mended();
  damage("kernels-fresh", ".so", 0, true);
  const Outcome r = run("render a.json -o b.exr --quiet", cache());
  EXPECT_EQ(r.exit_code, 1) << r.err;
  EXPECT_THAT(r.err, HasSubstr("delete its kernel cache kernels and kernels-fresh"));
  EXPECT_FALSE(files().count("b.exr"));
}

// brume's own files in it.

TEST_F(KernelCache, AKeptProgramRendersTheSame) {
  const fs::path kept = folder_ / "kernels/brume";
  ASSERT_THAT(kept_programs(), testing::AnyOf(1, 2));  // a whole, or two parts where a core was free
  for (const auto& entry : fs::directory_iterator(folder_ / "kernels"))
    if (entry.path() != kept) fs::remove_all(entry);  // what PoCL knows by itself
  const Outcome r = run("render a.json -o a.exr", cache());
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_THAT(r.err, testing::Not(HasSubstr("note")));
  EXPECT_EQ(run("compare a.exr good.exr --fail-above 0").exit_code, 0);
}

TEST_F(KernelCache, ADamagedProgramIsToldOnceAndBuiltAgain) {
  damage("kernels/brume", ".program", 0.5, false);
  const Outcome r = run("render a.json -o a.exr", cache());
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr(".program was damaged: it is removed, and built again\n"));
  EXPECT_EQ(run("compare a.exr good.exr --fail-above 0").exit_code, 0);
  EXPECT_THAT(run("render a.json -o b.exr", cache()).err, testing::Not(HasSubstr("note")));
}

TEST_F(KernelCache, WhereNoProgramCanBeKeptItIsBuilt) {
  fs::remove_all(folder_ / "kernels/brume");
  write("kernels/brume", "not a folder");
  const Outcome r = run("render a.json -o a.exr", cache());
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_THAT(r.err, testing::Not(HasSubstr("note")));
}

TEST_F(KernelCache, TwoAtOnceKeepWholePrograms) {
  fs::remove_all(folder_ / "kernels");
  const std::string render = "env " + cache() + " " BRUME_BINARY " render a.json --quiet -o ";
  const std::string both =
      "cd " + folder_.string() + " && { " + render + "a.exr & " + render + "b.exr; first=$?; wait $! && exit $first; }";
  EXPECT_EQ(std::system(both.c_str()), 0);
  for (const char* picture : {"a.exr", "b.exr"})
    EXPECT_EQ(run(std::string("compare good.exr --fail-above 0 ") + picture).exit_code, 0);
  for (const auto& entry : fs::directory_iterator(folder_ / "kernels/brume"))
    EXPECT_EQ(entry.path().extension(), ".program") << entry.path();  // nothing half-written
  EXPECT_THAT(kept_programs(), testing::AnyOf(1, 2, 3));
  EXPECT_THAT(run("render a.json -o c.exr", cache()).err, testing::Not(HasSubstr("note")));
}

// A core has to be free: brume is told so, whoever else is at work.
TEST_F(KernelCache, TwoPartsRenderWhatTheWholeRenders) {
  if (cores_usable() < 2) GTEST_SKIP() << "one core builds one program";
  fs::remove_all(folder_ / "kernels");
  ASSERT_EQ(run("render a.json -o parts.exr --quiet", cache() + " LD_PRELOAD=" BRUME_FREE_CORE).exit_code, 0);
  ASSERT_EQ(kept_programs(), 2);
  EXPECT_EQ(run("render a.json -o warm.exr --quiet", cache()).exit_code, 0);
  fs::remove_all(folder_ / "kernels");
  EXPECT_EQ(run("render a.json -o whole.exr --quiet", cache() + " POCL_MAX_PTHREAD_COUNT=1").exit_code, 0);
  EXPECT_EQ(kept_programs(), 1);
  EXPECT_EQ(run("compare whole.exr parts.exr --fail-above 0").exit_code, 0);
  EXPECT_EQ(run("compare whole.exr warm.exr --fail-above 0").exit_code, 0);
}

// Without the program that builds the other part there is a whole.
TEST_F(KernelCache, AloneItBuildsAWhole) {
  fs::copy_file(BRUME_BINARY, folder_ / "brume");
  fs::remove_all(folder_ / "kernels");
  const std::string render =
      "cd " + folder_.string() + " && env " + cache() + " ./brume render a.json -o a.png --quiet";
  EXPECT_EQ(std::system((render + " >/dev/null").c_str()), 0);
  EXPECT_EQ(kept_programs(), 1);
}

TEST_F(KernelCache, AnEmptyNameIsNone) {
  const Outcome r = run("render a.json -o a.exr --quiet", "POCL_CACHE_DIR= XDG_CACHE_HOME=" + folder_.string());
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_TRUE(fs::exists(folder_ / "pocl/kcache"));
}

TEST_F(KernelCache, OneThatCannotBeWrittenIsToldAndKeptElsewhere) {
  fs::create_directory(folder_ / "temporary");
  const std::string environment = "POCL_CACHE_DIR=/dev/null/x TMPDIR=" + (folder_ / "temporary").string();
  const Outcome r = run("render a.json -o a.exr", environment);
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("note: the kernel cache /dev/null/x cannot be written: kernels are kept in " +
                               (folder_ / "temporary/brume-kernels-").string()));
  // Nobody else may put kernels there.
  for (const auto& entry : fs::directory_iterator(folder_ / "temporary"))
    fs::permissions(entry, fs::perms::all, fs::perm_options::replace);
  const Outcome open = run("render a.json -o b.exr", environment);
  EXPECT_EQ(open.exit_code, 1);
  EXPECT_THAT(open.err, HasSubstr("the kernel cache /dev/null/x cannot be written"));
}

// Whether a render took generic kernels.
class GenericKernels : public KernelCache {
 protected:
  // Generic kernels are kept, and b.json needs others than a.json does.
  void SetUp() override {
    KernelCache::SetUp();
    std::string checkered = BALL;
    checkered.replace(checkered.find("\"diffuse\""), 0, "\"texture\": {\"type\": \"checker\"}, ");
    write("b.json", checkered);
    ASSERT_EQ(run("render a.json -o c.exr --quiet --generic", cache()).exit_code, 0);
  }
  bool generic(const std::string& options) {
    EXPECT_EQ(run("render b.json -o b.png --quiet --stats s.json " + options, cache()).exit_code, 0);
    return nlohmann::json::parse(text(folder_ / "s.json")).at("generic_kernels");
  }
};

TEST_F(GenericKernels, ServeASmallPictureWhileTheSceneHasNoneOfItsOwn) {
  EXPECT_TRUE(generic(""));
  EXPECT_TRUE(generic(""));
  EXPECT_FALSE(generic("-o b.exr"));  // from now on the scene has kernels
  EXPECT_FALSE(generic(""));
  EXPECT_TRUE(generic("--generic"));
}

TEST_F(GenericKernels, AreNotForLargePictures) { EXPECT_FALSE(generic("--size 320x320")); }

}  // namespace
}  // namespace brume::test
