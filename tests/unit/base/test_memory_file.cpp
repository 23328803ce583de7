// Bytes in memory under the name of a file.
#include "base/memory_file.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace brume {
namespace {

TEST(MemoryFile, IsThereAsLongAsItLives) {
  const std::string bytes = std::string("a\0b", 3) + std::string(100000, 'c');
  std::filesystem::path path;
  {
    const MemoryFile file(bytes);
    path = file.path();
    for (int i = 0; i < 2; ++i) {  // each from its begin
      std::ifstream in(path, std::ios::binary);
      EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), bytes);
    }
    EXPECT_TRUE(std::filesystem::is_regular_file(path));
    EXPECT_EQ(std::filesystem::file_size(path), bytes.size());
  }
  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_EQ(std::filesystem::file_size(MemoryFile("").path()), 0u);
}

}  // namespace
}  // namespace brume
