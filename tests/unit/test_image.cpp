// Image files: what is read and how it is decoded, what is refused and how, what is written and what is left behind.
#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>

#include "base/error.hpp"
#include "image/image.hpp"
#include "image/image_decode.hpp"
#include "image/image_format.hpp"
#include "image/image_program.hpp"

namespace fs = std::filesystem;
using namespace brume;
using testing::HasSubstr;

namespace {

fs::path data_path(const std::string& name) {
  const char* set = std::getenv("BRUME_TEST_DATA");
  return fs::path(set ? set : BRUME_SOURCE_DIR "/../shared/data") / name;
}

#define NEED_DATA(path) \
  if (!fs::exists(path)) GTEST_SKIP() << "absent: " << path

// A folder of its own for every test, removed at the end.
class ImageTest : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_)) names.push_back(entry.path().filename().string());
    return names;
  }
  template <class T>
  fs::path write(const std::string& name, int width, int channels, const OIIO::TypeDesc& type,
                 const std::vector<T>& values, const std::string& key = "", const std::string& value = "") {
    const fs::path file = folder_ / name;
    OIIO::ImageSpec spec(width, static_cast<int>(values.size()) / width / channels, channels, type);
    if (!key.empty()) spec.attribute(key, value);
    auto out = OIIO::ImageOutput::create(file.string());
    EXPECT_TRUE(out && out->open(file.string(), spec) && out->write_image(type, values.data()) && out->close());
    return file;
  }
  fs::path folder_ = fs::temp_directory_path() / ("brume-image-" + std::to_string(::getpid()));
};

template <class Error, class F>
std::string message_of(F f) {
  try {
    f();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing was thrown";
}

std::string refusal(const fs::path& file) {
  return message_of<InputError>([&] { image_read_texture(file); });
}

TEST(SrgbDecode, KnownValuesAndContinuity) {
  EXPECT_EQ(srgb_decode(0), 0);
  EXPECT_EQ(srgb_decode(1), 1);
  EXPECT_NEAR(srgb_decode(10 / 255.0), 10 / (255.0 * 12.92), 1e-16);
  EXPECT_NEAR(srgb_decode(128 / 255.0), 0.21586050011389926, 1e-15);
  EXPECT_NEAR(srgb_decode(0.04045), srgb_decode(0.0404500001), 1e-7);
}

TEST_F(ImageTest, IntegerTexturesAreDecodedExactly) {
  const Image bytes = image_read_texture(write<unsigned char>("a.png", 4, 1, OIIO::TypeDesc::UINT8, {0, 10, 128, 255}));
  ASSERT_EQ(bytes.values.size(), 12u);
  const float expected[] = {0, float(10 / (255 * 12.92)), 0.2158605f, 1};
  for (std::size_t i = 0; i < 12; ++i) EXPECT_FLOAT_EQ(bytes.values[i], expected[i / 3]) << i;
  EXPECT_TRUE(bytes.from_integers);

  const std::vector<unsigned short> codes = {0, 2570, 32896, 65535, 1, 40000};
  for (const char* name : {"b.png", "b.tif"}) {
    const Image words = image_read_texture(write(name, 6, 1, OIIO::TypeDesc::UINT16, codes));
    for (std::size_t i = 0; i < codes.size(); ++i)
      EXPECT_EQ(words.values[i * 3], float(srgb_decode(codes[i] / 65535.0))) << name << codes[i];
  }
}

// With alpha 0, what OpenImageIO writes is not divided by alpha, and a colour that reading multiplied would be 0.
TEST_F(ImageTest, AlphaIsDroppedAndNotMultipliedIn) {
  const std::vector<unsigned char> rgba = {128, 10, 255, 0}, grey_alpha = {128, 0};
  const Image color = image_read_texture(write("a.png", 1, 4, OIIO::TypeDesc::UINT8, rgba));
  const Image grey = image_read_texture(write("b.png", 1, 2, OIIO::TypeDesc::UINT8, grey_alpha));
  ASSERT_EQ(color.channels, 3);
  ASSERT_EQ(grey.channels, 3);
  EXPECT_FLOAT_EQ(color.values[0], 0.2158605f);
  EXPECT_FLOAT_EQ(color.values[1], float(10 / (255 * 12.92)));
  EXPECT_EQ(color.values[2], 1);
  for (float value : grey.values) EXPECT_FLOAT_EQ(value, 0.2158605f);
}

TEST_F(ImageTest, RowZeroIsTheTopRow) {
  const Image png =
      image_read_texture(write("a.png", 1, 1, OIIO::TypeDesc::UINT8, std::vector<unsigned char>{255, 0, 0}));
  EXPECT_EQ(png.height, 3);
  EXPECT_EQ(png.values[0], 1);
  EXPECT_EQ(png.values[6], 0);
  const fs::path exr =
      write("a.exr", 1, 1, OIIO::TypeDesc::FLOAT, std::vector<float>{7, 0, 0}, "openexr:lineOrder", "decreasingY");
  EXPECT_EQ(image_read_texture(exr).values[0], 7);
}

TEST_F(ImageTest, ContentDecidesAndNotTheExtension) {
  const fs::path file = write("a.png", 1, 1, OIIO::TypeDesc::UINT8, std::vector<unsigned char>{255});
  fs::rename(file, folder_ / "a.psd");
  EXPECT_EQ(image_read_texture(folder_ / "a.psd").values[0], 1);
  std::ofstream(folder_ / "text.png") << "not a picture";
  EXPECT_THAT(refusal(folder_ / "text.png"), HasSubstr("known: exr, png, jpg, hdr, tif"));
  EXPECT_THAT(refusal(folder_ / "absent.png"), HasSubstr("No such file"));
  EXPECT_THAT(refusal(folder_), HasSubstr("is a folder"));
}

TEST_F(ImageTest, OtherIntegersAreNoTexture) {
  const fs::path file = write("a.tif", 1, 1, OIIO::TypeDesc::UINT32, std::vector<unsigned>{1u << 31});
  EXPECT_THAT(refusal(file), HasSubstr("8- or 16-bit"));
  EXPECT_NEAR(image_read(file).values[0], 0.5, 1e-6);
}

TEST_F(ImageTest, SizesAreRefusedBeforeReading) {
  std::ofstream(folder_ / "wide.hdr") << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 16385\n";
  EXPECT_THAT(refusal(folder_ / "wide.hdr"), HasSubstr("16385 x 1 with 3 channels"));
  std::ofstream(folder_ / "big.hdr") << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16000 +X 16000\n";
  EXPECT_THAT(refusal(folder_ / "big.hdr"), HasSubstr("1024 MB"));
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

TEST(ImageData, NanInfAndNegativeTexelsAreCleanedAndCounted) {
  const fs::path file = data_path("textures/BrightRingsNanInf.exr");
  NEED_DATA(file);
  std::size_t bad = 0;
  for (float value : image_read(file).values) bad += !(std::isfinite(value) && value >= 0);
  const Image texture = image_read_texture(file);
  EXPECT_GT(bad, 0u);
  EXPECT_EQ(texture.cleaned, bad);
  for (float value : texture.values) ASSERT_TRUE(std::isfinite(value) && value >= 0);
}

TEST(ImageData, FloatsAreLinearAndUntouched) {
  const fs::path file = data_path("textures/GammaChart.exr");
  NEED_DATA(file);
  auto in = OIIO::ImageInput::open(file.string());
  std::vector<float> expected(800 * 800 * 3);
  ASSERT_TRUE(in && in->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, expected.data()));
  EXPECT_EQ(image_read_texture(file).values, expected);
}

TEST(ImageData, OneChannelOfExtremeFloatsBecomesGrey) {
  const fs::path file = data_path("textures/WideFloatRange.exr");
  NEED_DATA(file);
  const Image raw = image_read(file), texture = image_read_texture(file);
  ASSERT_EQ(raw.channels, 1);
  EXPECT_GT(*std::max_element(raw.values.begin(), raw.values.end()), 1e37f);
  for (std::size_t i = 0; i < texture.values.size(); ++i)
    ASSERT_EQ(texture.values[i], std::max(raw.values[i / 3], 0.0f));
}

TEST(ImageData, JpegIsDecoded) {
  const fs::path file = data_path("textures/earthmap.jpg");
  NEED_DATA(file);
  const Image texture = image_read_texture(file), raw = image_read(file);
  EXPECT_EQ(texture.width, 1024);
  EXPECT_EQ(texture.height, 512);
  EXPECT_EQ(raw.channel_names, (std::vector<std::string>{"R", "G", "B"}));
  for (std::size_t i = 0; i < raw.values.size(); i += 1001)
    ASSERT_NEAR(texture.values[i], srgb_decode(raw.values[i]), 1e-6);
  EXPECT_EQ(texture.cleaned, 0u);
}

// The library's own libraries start threads and take time to load: none of that is in this process.
TEST_F(ImageTest, TheLibraryIsInAnotherProcess) {
  const std::vector<float> rgb(64 * 64 * 3, 0.5f);
  image_write_exr(folder_ / "a.exr", 64, 64, {{"R", rgb.data()}}, {});
  image_write_display(folder_ / "a.png", 64, 64, rgb);
  EXPECT_EQ(image_read(folder_ / "a.exr").values[0], 0.5f);
  EXPECT_EQ(image_read(folder_ / "a.png").channels, 3);
}

// The running brume-image of this process.
pid_t image_child() {
  pid_t child = 0;
  std::ifstream("/proc/self/task/" + std::to_string(::getpid()) + "/children") >> child;
  EXPECT_GT(child, 0);
  return child;
}

TEST_F(ImageTest, AProgramKilledFromOutsideIsStartedOnceMore) {
  const std::vector<float> rgb(12, 0.5f);
  ImageProgram::reader().stop();
  ImageProgram::writer().stop();
  for (const int signal : {SIGKILL, SIGTERM, SIGSEGV}) {
    image_check_writable(folder_ / "a.png");
    ::kill(image_child(), signal);
    image_write_display(folder_ / "a.png", 2, 2, rgb);
    ImageProgram::writer().stop();
    ImageProgram::reader().start();
    ::kill(image_child(), signal);
    if (signal == SIGSEGV) {
      EXPECT_THAT(refusal(folder_ / "a.png"), HasSubstr("makes the image library crash (signal 11)"));
    } else {
      EXPECT_EQ(image_read(folder_ / "a.png").width, 2);
    }
    ImageProgram::reader().stop();
  }
  EXPECT_THAT(files(), testing::ElementsAre("a.png"));
}

TEST_F(ImageTest, FailedWritesKeepWhatWasThereAndSayWhatTheSystemSays) {
  std::vector<float> noise;
  for (unsigned i = 0, x = 1; i < 300 * 300 * 3; ++i)
    noise.push_back(float((x = x * 1664525u + 1013904223u) >> 8) * 0x1p-24f);
  const auto write_all = [&](const char* name) {
    const fs::path file = folder_ / name;
    if (file.extension() == ".exr") return image_write_exr(file, 300, 300, {{"R", noise.data()}}, {});
    image_write_display(file, 300, 300, noise);
  };
  rlimit old{};
  ::getrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{4096, old.rlim_max};
  for (const char* name : {"a.exr", "a.png", "a.JPEG"}) {
    std::ofstream(folder_ / name) << "old";
    ImageProgram::writer().stop();
    ::setrlimit(RLIMIT_FSIZE, &small);  // brume-image, too, lives under it
    const std::string message = message_of<RuntimeError>([&] { write_all(name); });
    ::setrlimit(RLIMIT_FSIZE, &old);
    EXPECT_EQ(message, (folder_ / name).string() + ": cannot be written: File too large");
    EXPECT_EQ(fs::file_size(folder_ / name), 3u);
    write_all(name);
    EXPECT_EQ(image_read(folder_ / name).width, 300);
  }
  EXPECT_THAT(files(), testing::UnorderedElementsAre("a.exr", "a.png", "a.JPEG"));
}

TEST_F(ImageTest, WritabilityIsKnownBeforeRendering) {
  const auto input = [](const fs::path& file) { return message_of<InputError>([&] { image_check_writable(file); }); };
  const auto runtime = [](const fs::path& file) {
    return message_of<RuntimeError>([&] { image_check_writable(file); });
  };
  EXPECT_THAT(input(folder_ / "a.xyz"), HasSubstr("known: .exr, .png, .jpg, .jpeg"));
  EXPECT_THAT(input(folder_ / "a.hdr"), HasSubstr("'.hdr'"));
  EXPECT_THAT(runtime(folder_ / "none" / "a.png"), HasSubstr((folder_ / "none").string() + "' does not exist"));
  fs::create_directory(folder_ / "folder.png");
  EXPECT_THAT(runtime(folder_ / "folder.png"), HasSubstr("is a folder"));
  fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
  if (::geteuid() != 0) {
    EXPECT_THAT(runtime(folder_ / "a.png"), HasSubstr("cannot write into the folder '" + folder_.string()));
  }
  fs::permissions(folder_, fs::perms::owner_all);
  image_check_writable(folder_ / "a.png");
  EXPECT_THAT(files(), testing::ElementsAre("folder.png"));
}

}  // namespace
