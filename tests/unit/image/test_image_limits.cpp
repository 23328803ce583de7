// Images that are damaged or too large: one line each, and little memory.
#include <sys/resource.h>

#include <cmath>

#include "image/image_program.hpp"
#include "unit/image/image_fixture.hpp"

namespace brume::test {
namespace {

TEST_F(ImageTest, SizesAreRefusedBeforeReading) {
  std::ofstream(folder_ / "wide.hdr") << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 16385\n";
  EXPECT_THAT(refusal(folder_ / "wide.hdr"), HasSubstr("16385 x 1 with 3 channels"));
  std::ofstream(folder_ / "big.hdr") << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16000 +X 16000\n";
  EXPECT_THAT(refusal(folder_ / "big.hdr"), HasSubstr("1024 MB"));
}

// Progressive, and nothing behind its header: the library wants 25 GB before it says a size.
std::string jpeg_bomb(int width, int height, const std::string& before = "") {
  const auto word = [](int n) { return std::string{char(n >> 8), char(n & 255)}; };
  const auto segment = [&](int code, const std::string& body) {
    return std::string{char(0xFF), char(code)} + word(int(body.size()) + 2) + body;
  };
  std::string counts(17, '\0');
  counts[1] = 1;
  return "\xff\xd8" + before + segment(0xDB, std::string(1, '\0') + std::string(64, '\1')) +
         segment(0xC2, "\x08" + word(height) + word(width) + std::string("\3\1\x11\0\2\x11\0\3\x11\0", 10)) +
         segment(0xC4, counts + std::string(1, '\0')) + segment(0xDA, std::string("\3\1\0\2\0\3\0\0\0\0", 10)) +
         std::string(10, '\0') + "\xff\xd9";
}

TEST_F(ImageTest, ProgressiveBombsAreRefusedByTheirHeader) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the memory of a sanitized process is not that of the program";
#endif
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const std::string fill(3, '\xff'), segment = std::string("\xff\xe1\0\6\xff\xc0\0\0", 8);  // a frame only to look at
  for (const std::string& before : {std::string(), segment, fill, segment + "garbage" + std::string(1, '\0')}) {
    std::ofstream(folder_ / "bomb.jpg", std::ios::binary) << jpeg_bomb(65500, 65500, before);
    const auto read_and_exit = [&] {
      const std::string message = refusal(folder_ / "bomb.jpg");
      rusage used{};
      ::getrusage(RUSAGE_CHILDREN, &used);
      std::fputs(message.c_str(), stderr);
      ::_exit(used.ru_maxrss < 300 * 1024 ? 0 : 1);
    };
    EXPECT_EXIT(read_and_exit(), testing::ExitedWithCode(0), "65500 x 65500 with 3 channels needs .* at most 16384");
  }
  std::ofstream(folder_ / "small.jpg", std::ios::binary) << jpeg_bomb(64, 48);
  EXPECT_EQ(image_read(folder_ / "small.jpg").width, 64);
}

TEST_F(ImageTest, TheReaderLivesUnderALimitOfMemory) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the memory of a sanitized process is not that of the program";
#endif
  write("a.png", 1, 1, OIIO::TypeDesc::UINT8, std::vector<unsigned char>{255});
  ImageProgram::writer().stop();
  ImageProgram::reader().stop();
  image_read(folder_ / "a.png");
  std::ifstream limits("/proc/" + std::to_string(image_child()) + "/limits");
  long long bytes = 0;
  for (std::string line; std::getline(limits, line);)
    if (line.rfind("Max data size", 0) == 0) bytes = std::atoll(line.c_str() + 13);  // "unlimited" is 0
  EXPECT_GT(bytes, 3ll << 30);
  EXPECT_LT(bytes, 8ll << 30);
}

// The library's own messages hold the name, too, and some bytes of the file.
TEST_F(ImageTest, MessagesNameTheFileOnce) {
  const fs::path exr = write("whole.exr", 64, 1, OIIO::TypeDesc::FLOAT, std::vector<float>(64 * 64, 0.3f));
  std::ifstream in(exr, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(in), {});
  for (const std::size_t cut : {std::size_t(9), std::size_t(60), bytes.size() / 2}) {
    const fs::path file = folder_ / "b\xE4 \xC3\xA4.exr";
    std::ofstream(file, std::ios::binary) << bytes.substr(0, cut) << "\xE4\x01\x02";
    const std::string message = refusal(file);
    const std::string behind = message.substr(file.string().size());
    EXPECT_EQ(message.rfind(file.string() + ": ", 0), 0u) << message;
    EXPECT_EQ(behind.find(folder_.string()), std::string::npos) << message;
    for (const char c : behind) EXPECT_TRUE(c >= ' ' && c <= '~') << message;
  }
}

TEST(ImageDamaged, EveryFileEndsInAnErrorOrAnImage) {
  const fs::path folder = data_path("damaged");
  NEED_DATA(folder);
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    ++files;
    try {
      const Image image = image_read_texture(entry.path());
      for (float value : image.values) ASSERT_TRUE(std::isfinite(value) && value >= 0) << entry.path();
      EXPECT_EQ(image.values.size(), std::size_t(image.width) * std::size_t(image.height) * 3);
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).rfind(entry.path().string() + ": ", 0), 0u) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  }
  EXPECT_GT(files, 30);
}

// Endless recursion: crashes everywhere. (corrupt-icc-4552.jpg reads out of bounds: abort or segfault, by chance.)
TEST(ImageDamaged, ACrashOfTheLibraryIsAnError) {
  const fs::path file = data_path("damaged/oiio/xmp-deep-nesting.png");
  NEED_DATA(file);
  EXPECT_THAT(refusal(file), HasSubstr("makes the image library crash ("));
}

TEST(ImageDamaged, BombsTakeLittleMemoryAndSaySizeAndLimit) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the memory of a sanitized process is not that of the program";
#endif
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // a fresh process, not a copy of this one and its memory
  for (const char* name : {"bomb-40000.hdr", "bomb-65500x65500.jpg", "bomb.png", "bomb.exr", "bomb-65535.bmp"}) {
    const fs::path file = data_path("damaged/oiio") / name;
    NEED_DATA(file);
    const auto read_and_exit = [&] {  // in a process of its own, whose children are only those of this read
      const std::string message = refusal(file);
      rusage used{};
      ::getrusage(RUSAGE_CHILDREN, &used);
      std::fputs(message.c_str(), stderr);
      ::_exit(used.ru_maxrss < 500 * 1024 ? 0 : 1);
    };
    const bool sized = std::string(name) != "bomb.exr" && std::string(name) != "bomb-65535.bmp";
    EXPECT_EXIT(read_and_exit(), testing::ExitedWithCode(0), sized ? "0 x .*at most 16384 x 16384 and 1024 MB" : "bomb")
        << name;
  }
}

}  // namespace
}  // namespace brume::test
