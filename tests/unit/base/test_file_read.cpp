// What is read of the files that users name: regular ones of a bounded size, and an answer at once for everything else.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <fstream>

#include "base/error.hpp"
#include "base/file_read.hpp"
#include "image/image.hpp"
#include "mesh/mesh.hpp"
#include "scene/scene_reader.hpp"

namespace brume::test {
namespace {

namespace fs = std::filesystem;
using testing::EndsWith;
using testing::HasSubstr;

class FileRead : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  fs::path pipe(const std::string& name) const {
    EXPECT_EQ(::mkfifo((folder_ / name).c_str(), 0600), 0);
    return folder_ / name;
  }
  template <class F>
  static std::string refusal_of(F read) {
    try {
      read();
    } catch (const InputError& error) {
      return error.what();
    }
    return "nothing was thrown";
  }
  static std::string refusal(const fs::path& file) {
    return refusal_of([&] { file_read_text(file, 10, "a list"); });
  }
  fs::path folder_ = fs::temp_directory_path() / ("brume-read-" + std::to_string(::getpid()));
};

TEST_F(FileRead, TextUpToTheLimit) {
  EXPECT_EQ(file_read_text(write("a", "0123456789"), 10, "a list"), "0123456789");
  EXPECT_EQ(file_read_text(write("b", ""), 10, "a list"), "");
  EXPECT_EQ(refusal(write("c", "0123456789a")),
            (folder_ / "c").string() + ": is too large, expected a list of at most 10 bytes");
  EXPECT_THAT(refusal(write("d", std::string("01\0a", 4))),
              EndsWith("d: is not a plain text file (binary or UTF-16), expected a list in UTF-8"));
  EXPECT_EQ(file_head(write("e", "0123456789"), 4, 10, "a list"), "0123");
  EXPECT_THAT(file_read_text("/proc/self/stat", 4096, "a list"), HasSubstr(std::to_string(::getpid())));
  EXPECT_THAT(refusal("/proc/self/stat"), HasSubstr("too large"));  // though its size is said to be 0
}

TEST_F(FileRead, EverythingElseIsRefusedAtOnce) {
  EXPECT_THAT(refusal(folder_), HasSubstr("is a folder, expected a list"));
  EXPECT_THAT(refusal(folder_ / "none"), HasSubstr("cannot be opened: No such file"));
  for (const fs::path& file : {fs::path("/dev/zero"), fs::path("/dev/null"), fs::path("/dev/tty"), pipe("pipe")})
    EXPECT_THAT(refusal(file), testing::AnyOf(HasSubstr(": is not a regular file, expected a list of at most 10 bytes"),
                                              HasSubstr("/dev/tty: cannot be opened")))
        << file;
  fs::create_symlink("/dev/zero", folder_ / "link");
  EXPECT_THAT(refusal(folder_ / "link"), HasSubstr("not a regular file"));
  fs::create_symlink("circle", folder_ / "circle");
  EXPECT_THAT(refusal(folder_ / "circle"), HasSubstr("cannot be opened: Too many levels"));
}

// A terabyte of zeros that takes no room on the disk.
TEST_F(FileRead, EveryReaderOfSideFilesGoesThroughIt) {
  const auto start = std::chrono::steady_clock::now();
  const fs::path fifo = pipe("pipe"), huge = write("huge", "");
  ASSERT_EQ(::truncate(huge.c_str(), off_t(1) << 40), 0);
  for (const fs::path& file : {fs::path("/dev/zero"), fifo, huge}) {
    const std::string cause = file == huge ? "is too large" : "is not a regular file";
    EXPECT_THAT(refusal_of([&] { scene_read(file, {}); }), HasSubstr(cause));
    EXPECT_THAT(refusal_of([&] { image_read_texture(file); }), HasSubstr(cause));
    EXPECT_THAT(refusal_of([&] { mesh_read_obj(file); }), HasSubstr(cause));
    const fs::path obj =
        write("a.obj", "mtllib " + fs::relative(file, folder_).string() + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_THAT(mesh_read_obj(obj).notes, testing::ElementsAre(HasSubstr(cause)));
  }
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(1));
}

TEST_F(FileRead, EndingsAreOfAnyCase) {
  EXPECT_EQ(file_ending("a/SMOKE.VDB"), ".vdb");
  EXPECT_EQ(file_ending("a.b/smoke"), "");
}

}  // namespace
}  // namespace brume::test
