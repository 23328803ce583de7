// A file that is written whole or not at all.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "base/atomic_file.hpp"
#include "base/error.hpp"

namespace brume::test {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> files_of(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  return names;
}

class AtomicFileTest : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  std::string text(const std::string& name) const {
    std::string all;
    std::getline(std::ifstream(folder_ / name), all, '\0');
    return all;
  }
  template <class F>
  static std::string failure(F write) {
    try {
      write();
    } catch (const RuntimeError& error) {
      return error.what();
    }
    return "nothing was thrown";
  }
  fs::path folder_ = fs::temp_directory_path() / ("brume-atomic-" + std::to_string(::getpid()));
};

TEST_F(AtomicFileTest, IsAllOrNothing) {
  atomic_write(folder_ / "a.txt", "old");
  {
    AtomicFile dropped(folder_ / "a.txt");
    dropped.write("new");
  }
  EXPECT_EQ(text("a.txt"), "old");
  EXPECT_THAT(files_of(folder_), testing::ElementsAre("a.txt"));
  EXPECT_THAT(failure([] { AtomicFile file("/dev/null"); }), testing::HasSubstr("not a regular file"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(AtomicFileTest, LinksAreFollowedWhetherSomethingIsThereOrNot) {
  atomic_write(folder_ / "a.txt", "old");
  fs::create_symlink("a.txt", folder_ / "link.txt");
  fs::create_directories(folder_ / "sub");
  fs::create_symlink("sub/b.txt", folder_ / "dangling.txt");
  fs::create_symlink(folder_ / "dangling.txt", folder_ / "sub/twice.txt");
  fs::create_symlink("none/b.txt", folder_ / "nowhere.txt");
  fs::create_symlink("circle.txt", folder_ / "circle.txt");
  atomic_write(folder_ / "link.txt", "new");
  EXPECT_EQ(text("a.txt"), "new");
  atomic_write(folder_ / "sub/twice.txt", "far");
  EXPECT_EQ(text("sub/b.txt"), "far");
  for (const char* link : {"link.txt", "dangling.txt", "sub/twice.txt"}) EXPECT_TRUE(fs::is_symlink(folder_ / link));
  EXPECT_THAT(failure([&] { AtomicFile file(folder_ / "nowhere.txt"); }), testing::HasSubstr("does not exist"));
  EXPECT_THAT(failure([&] { AtomicFile file(folder_ / "circle.txt"); }), testing::HasSubstr("leads in a circle"));
}

TEST_F(AtomicFileTest, SpellingsOfOneFileHaveOneTarget) {
  fs::create_directories(folder_ / "sub");
  fs::create_symlink("../a.txt", folder_ / "sub/link.txt");
  fs::create_directory_symlink("sub", folder_ / "door");
  const fs::path a = file_target(folder_ / "a.txt");
  for (const char* spelling : {"./a.txt", "sub/../a.txt", "sub//../a.txt", "sub/link.txt", "door/link.txt"})
    EXPECT_EQ(file_target(folder_ / spelling), a) << spelling;
  EXPECT_EQ(file_target(fs::relative(folder_ / "a.txt")), a);
  EXPECT_NE(file_target(folder_ / "b.txt"), a);
}

// What a killed run has left goes; what another one is writing stays, and so does everything that only looks alike.
TEST_F(AtomicFileTest, RemovesWhatAKilledRunHasLeft) {
  for (const char* name : {"a.txt.tmp-1", "a.txt.tmp-4194000", "b.txt.tmp-1", "a.txt.tmp-old", "a.txt.tmp"})
    std::ofstream(folder_ / name) << "x";
  const int held = ::open((folder_ / "a.txt.tmp-1").c_str(), O_WRONLY);
  ASSERT_EQ(::flock(held, LOCK_EX), 0);
  AtomicFile file(folder_ / "a.txt");
  EXPECT_THAT(files_of(folder_), testing::UnorderedElementsAre("a.txt.tmp-1", "b.txt.tmp-1", "a.txt.tmp-old",
                                                               "a.txt.tmp", file.temporary().filename().string()));
  { AtomicFile another(folder_ / "b.txt"); }
  EXPECT_TRUE(fs::exists(file.temporary()));
  ::close(held);
}

// As of a full disk, which needs a disk: a limit on the size of files is told in the same way.
TEST_F(AtomicFileTest, SaysWhatTheSystemSaysAndKeepsTheOldFile) {
  atomic_write(folder_ / "a.txt", "old");
  rlimit old{};
  ::getrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{4096, old.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &small);
  const std::string said = failure([&] { atomic_write(folder_ / "a.txt", std::string(5000, 'x')); });
  ::setrlimit(RLIMIT_FSIZE, &old);
  EXPECT_EQ(said, (folder_ / "a.txt").string() + ": cannot be written: File too large");
  EXPECT_EQ(text("a.txt"), "old");
  EXPECT_THAT(files_of(folder_), testing::ElementsAre("a.txt"));
}

}  // namespace
}  // namespace brume::test
