// The files in which built programs are kept: what was written comes back, or nothing; another device, driver, source
// or setting has another file; they do not grow without end.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "cl/program_cache.hpp"

namespace brume {
namespace {

namespace fs = std::filesystem;

class ProgramFiles : public testing::Test {
 protected:
  void SetUp() override {
    char name[] = "/tmp/brume_test_XXXXXX";
    folder_ = mkdtemp(name);
    ::setenv("POCL_WORK_GROUP_SPECIALIZATION", "0", 1);
  }
  void TearDown() override {
    fs::remove_all(folder_);
    ::unsetenv("POCL_WORK_GROUP_SPECIALIZATION");
  }

  static std::string text(const fs::path& file) {
    std::ostringstream all;
    all << std::ifstream(file, std::ios::binary).rdbuf();
    return all.str();
  }
  static void write(const fs::path& file, const std::string& bytes) { std::ofstream(file, std::ios::binary) << bytes; }

  fs::path folder_;
};

DeviceInfo device() {
  DeviceInfo info{};
  info.platform = POCL_PLATFORM;
  info.platform_version = "OpenCL 3.0 PoCL 3.1, LLVM 15.0.6";
  info.name = "pthread-skylake-avx512-AMD EPYC";
  info.version = "OpenCL 3.0 PoCL HSTR: pthread-x86_64-pc-linux-gnu-skylake-avx512";
  info.driver = "3.1+debian";
  return info;
}

TEST_F(ProgramFiles, WhatWasWrittenComesBack) {
  const fs::path file = folder_ / "new/folder/a.program";
  EXPECT_FALSE(program_file_read(file));
  for (const std::size_t bytes : {0, 1, 7, 8, 9, 100000}) {
    std::string binary(bytes, 'x');
    if (bytes > 5) binary[5] = '\0';
    program_file_write(file, binary);
    EXPECT_EQ(program_file_read(file), binary) << bytes;
  }
}

TEST_F(ProgramFiles, AnyDamagedByteIsSeenAndTheFileRemoved) {
  const fs::path file = folder_ / "a.program";
  program_file_write(file, "some binary");
  const std::string good = text(file);
  testing::internal::CaptureStderr();
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 4);
    write(file, bad);
    EXPECT_FALSE(program_file_read(file)) << "byte " << i;
    EXPECT_FALSE(fs::exists(file)) << "byte " << i;
  }
  for (std::size_t bytes = 0; bytes < good.size(); ++bytes) {
    write(file, good.substr(0, bytes));
    EXPECT_FALSE(program_file_read(file)) << "cut at " << bytes;
  }
  write(file, good + "x");
  EXPECT_FALSE(program_file_read(file));
  write(folder_ / "b.program", good);
  EXPECT_FALSE(program_file_read(folder_ / "b.program")) << "it was another's";
  EXPECT_THAT(testing::internal::GetCapturedStderr(), testing::HasSubstr("b.program was damaged"));
}

TEST_F(ProgramFiles, TheOldestGo) {
  const std::string binary(1000, 'x');
  const auto now = fs::file_time_type::clock::now();
  for (int i = 0; i < 5; ++i) {
    const fs::path file = folder_ / std::to_string(i);
    program_file_write(file, binary);
    fs::last_write_time(file, now - std::chrono::hours(i == 2 ? 0 : 10 - i));  // 2 was used last
  }
  program_file_write(folder_ / "5", binary, 3200);
  std::set<std::string> left;
  for (const auto& entry : fs::directory_iterator(folder_)) left.insert(entry.path().filename());
  EXPECT_THAT(left, testing::UnorderedElementsAre("2", "4", "5"));
}

TEST_F(ProgramFiles, AFolderThatCannotBeIsNoError) {
  write(folder_ / "file", "");
  EXPECT_NO_THROW(program_file_write(folder_ / "file/a.program", "binary"));
  EXPECT_FALSE(program_file_read(folder_ / "file/a.program"));
}

TEST_F(ProgramFiles, EveryPartOfTheKeyIsAnotherFile) {
  std::vector<fs::path> files{program_file(device(), "source", "-DA=1")};
  EXPECT_EQ(program_file(device(), "source", "-DA=1"), files[0]);
  for (std::string DeviceInfo::*part :
       {&DeviceInfo::platform_version, &DeviceInfo::name, &DeviceInfo::version, &DeviceInfo::driver}) {
    DeviceInfo other = device();
    (other.*part).back() = '!';
    files.push_back(program_file(other, "source", "-DA=1"));
  }
  files.push_back(program_file(device(), "Source", "-DA=1"));
  files.push_back(program_file(device(), "source", "-DA=2"));
  files.push_back(program_file(device(), "source-DA=1", ""));
  ::setenv("POCL_WORK_GROUP_METHOD", "cbs", 1);
  files.push_back(program_file(device(), "source", "-DA=1"));
  ::unsetenv("POCL_WORK_GROUP_METHOD");
  for (const char* indifferent : {"POCL_MAX_PTHREAD_COUNT", "POCL_AFFINITY"}) {
    ::setenv(indifferent, "1", 1);
    EXPECT_EQ(program_file(device(), "source", "-DA=1"), files[0]) << indifferent;
    ::unsetenv(indifferent);
  }
  EXPECT_EQ(std::set<fs::path>(files.begin(), files.end()).size(), files.size());
}

TEST_F(ProgramFiles, OnlyOfGenericKernelsOfPocl) {
  DeviceInfo other = device();
  other.platform = "rusticl";
  EXPECT_TRUE(program_file(other, "source", "").empty());
  ::setenv("POCL_WORK_GROUP_SPECIALIZATION", "1", 1);
  EXPECT_TRUE(program_file(device(), "source", "").empty());
}

}  // namespace
}  // namespace brume
