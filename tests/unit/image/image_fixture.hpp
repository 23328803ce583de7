// What the tests of images share: a folder, files that brume does not write, what is thrown.
#pragma once
#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "base/error.hpp"
#include "image/image.hpp"

namespace brume::test {

namespace fs = std::filesystem;
using testing::HasSubstr;

inline fs::path data_path(const std::string& name) {
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

inline std::string refusal(const fs::path& file) {
  return message_of<InputError>([&] { image_read_texture(file); });
}

// The running brume-image of this process.
inline pid_t image_child() {
  pid_t child = 0;
  std::ifstream("/proc/self/task/" + std::to_string(::getpid()) + "/children") >> child;
  EXPECT_GT(child, 0);
  return child;
}

}  // namespace brume::test
