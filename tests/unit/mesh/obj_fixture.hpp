// Fixture for tests of OBJ files: a folder to write them in, and what the reader says to them.
#pragma once
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "base/error.hpp"
#include "mesh/mesh.hpp"

namespace brume::test {

namespace fs = std::filesystem;

// A folder of its own for every test, removed at the end.
class Obj : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("brume-obj-" + std::to_string(::getpid()) + "-" +
                                           testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path write(const std::string& text, const std::string& name = "a.obj") const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  Mesh read(const std::string& text) const { return mesh_read_obj(write(text)); }

  // The message of the InputError, or "accepted". It always begins with the file and is one line.
  std::string refusal(const std::string& text) const {
    const fs::path file = write(text);
    try {
      mesh_read_obj(file);
    } catch (const InputError& error) {
      const std::string message = error.what();
      EXPECT_THAT(message, testing::StartsWith(file.string() + ": ")) << text;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      return message;
    }
    return "accepted";
  }

  fs::path folder_;
};

inline const char* const TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

}  // namespace brume::test
