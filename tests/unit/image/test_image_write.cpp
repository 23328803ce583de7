// Images out: what is written, what is left behind, and a program that dies.
#include <sys/resource.h>

#include <csignal>

#include "image/image_program.hpp"
#include "unit/image/image_fixture.hpp"

namespace brume::test {
namespace {

TEST_F(ImageTest, AWindowIsWrittenAsTheDataWindow) {
  std::vector<float> values(12);
  for (int i = 0; i < 12; ++i) values[std::size_t(i)] = float(i);
  image_write_exr(folder_ / "a.exr", 4, 3, {{"Y", values.data()}}, {}, {1, 1, 3, 2});
  const auto in = OIIO::ImageInput::open((folder_ / "a.exr").string());
  ASSERT_TRUE(in);
  const OIIO::ImageSpec& spec = in->spec();
  EXPECT_EQ(spec.x * 1000 + spec.y * 100 + spec.width * 10 + spec.height, 1121);
  EXPECT_EQ(spec.full_x * 1000 + spec.full_y * 100 + spec.full_width * 10 + spec.full_height, 43);
  EXPECT_EQ(image_read(folder_ / "a.exr").values, (std::vector<float>{0, 0, 0, 0, 0, 5, 6, 0, 0, 0, 0, 0}));
}

// The library's own libraries start threads and take time to load: none of that is in this process.
TEST_F(ImageTest, TheLibraryIsInAnotherProcess) {
  const std::vector<float> rgb(64 * 64 * 3, 0.5f);
  image_write_exr(folder_ / "a.exr", 64, 64, {{"R", rgb.data()}}, {});
  image_write_display(folder_ / "a.png", 64, 64, rgb);
  EXPECT_EQ(image_read(folder_ / "a.exr").values[0], 0.5f);
  EXPECT_EQ(image_read(folder_ / "a.png").channels, 3);
}

// PNG goes without it, whose loading is most of what a small picture would cost.
TEST_F(ImageTest, PngIsWrittenWithoutTheProgram) {
  ImageProgram::writer().stop();
  std::vector<float> rgba;
  for (int i = 0; i < 12; ++i) rgba.push_back(float(i) / 11);
  image_check_writable(folder_ / "a.png");
  image_write_display(folder_ / "a.png", 1, 3, rgba, true);
  ImageProgram::reader().stop();
  std::string children;
  std::getline(std::ifstream("/proc/self/task/" + std::to_string(::getpid()) + "/children"), children);
  EXPECT_EQ(children, "");
  const Image read = image_read(folder_ / "a.png");
  ASSERT_EQ(read.values.size(), rgba.size());
  for (std::size_t i = 0; i < rgba.size(); ++i)
    EXPECT_EQ(std::round(read.values[i] * 255), std::round(rgba[i] * 255)) << i;
}

TEST_F(ImageTest, AProgramKilledFromOutsideIsStartedOnceMore) {
#ifdef __SANITIZE_ADDRESS__
  constexpr const char* ENDED = "\\((signal 11|exit code 1)\\)";  // the sanitizer, once it is loaded, exits by itself
#else
  constexpr const char* ENDED = "\\(signal 11\\)";
#endif
  const std::vector<float> rgb(12, 0.5f);
  ImageProgram::reader().stop();
  ImageProgram::writer().stop();
  for (const int signal : {SIGKILL, SIGTERM, SIGSEGV}) {
    image_check_writable(folder_ / "a.jpg");
    ::kill(image_child(), signal);
    image_write_display(folder_ / "a.jpg", 2, 2, rgb);
    ImageProgram::writer().stop();
    ImageProgram::reader().start();
    ::kill(image_child(), signal);
    if (signal == SIGSEGV) {
      EXPECT_THAT(refusal(folder_ / "a.jpg"),
                  testing::ContainsRegex(std::string("makes the image library crash ") + ENDED));
    } else {
      EXPECT_EQ(image_read(folder_ / "a.jpg").width, 2);
    }
    ImageProgram::reader().stop();
  }
  EXPECT_THAT(files(), testing::ElementsAre("a.jpg"));
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

TEST_F(ImageTest, WhatBrumeSaysInAFileComesBack) {
  const std::vector<float> values(4, 1.0f);
  const std::string odd = "spaces, \"quotes\" and \xc3\xbc", huge(5000, 'x');
  const ImageMetadata given{{"brume:spp", "16"}, {"other:key", "x"}, {"brume:scene", odd}, {"brume:huge", huge}};
  image_write_exr(folder_ / "a.exr", 2, 2, {{"R", values.data()}}, given);
  const Image read = image_read(folder_ / "a.exr");
  EXPECT_EQ(read.channel_names, std::vector<std::string>{"R"});
  EXPECT_THAT(read.metadata, testing::UnorderedElementsAre(given[0], given[2]));
  EXPECT_EQ(*metadata_find(read.metadata, "brume:spp"), "16");
  EXPECT_EQ(metadata_find(read.metadata, "brume:huge"), nullptr);
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
}  // namespace brume::test
