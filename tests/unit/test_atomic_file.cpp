// A file that is written whole or not at all.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

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

TEST(AtomicFile, IsAllOrNothing) {
  const fs::path folder = fs::temp_directory_path() / ("brume-atomic-" + std::to_string(::getpid()));
  fs::create_directories(folder);
  atomic_write(folder / "a.txt", "old");
  { AtomicFile dropped(folder / "a.txt"); }
  EXPECT_THAT(files_of(folder), testing::ElementsAre("a.txt"));
  fs::create_symlink("a.txt", folder / "link.txt");
  atomic_write(folder / "link.txt", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link.txt"));
  std::string text;
  std::ifstream(folder / "a.txt") >> text;
  EXPECT_EQ(text, "new");
  std::string refusal;
  try {
    AtomicFile file("/dev/null");
  } catch (const RuntimeError& error) {
    refusal = error.what();
  }
  EXPECT_THAT(refusal, testing::HasSubstr("not a regular file"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  fs::remove_all(folder);
}

}  // namespace
}  // namespace brume::test
