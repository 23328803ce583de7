// A program in two parts, the second of them built by brume-kernels: whatever that one does, both have their kernels.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "base/helper_program.hpp"
#include "cl/device.hpp"
#include "cl/program.hpp"
#include "cl/program_parts.hpp"

namespace brume {
namespace {

namespace fs = std::filesystem;

constexpr const char* FIRST = "#include \"passes/accumulate.cl\"\n";
constexpr const char* SECOND = "#include \"passes/secondary_rays.cl\"\n";

const PartedSource& source() {
  static const PartedSource one{kernel_source_text(std::string(FIRST) + SECOND, "passes"), {FIRST, SECOND}};
  return one;
}

fs::path brume_kernels() { return helper_program_file("brume-kernels", "tests"); }

// Each test builds programs that nobody has built before, and leaves none.
class ProgramParts : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override {
    forget();
    fs::remove_all(folder_);
  }

  fs::path kept(std::size_t part) const {
    return program_kept_file(context_, part_keys(source()).parts[part], options_);
  }
  // Removes what is kept, and turns to programs that are not built yet.
  void forget() {
    for (const fs::path& file : {kept(0), kept(1), program_kept_file(context_, part_keys(source()).whole, options_)})
      fs::remove(file);
    options_ = "-DTEST=" + std::to_string(std::random_device{}());
  }

  std::vector<cl::Program> build(const fs::path& other) {
    return parts_build(context_, source(), options_, [&] { return ++asked_, other; });
  }
  // A program in the place of brume-kernels.
  fs::path script(const std::string& text) const {
    const fs::path file = folder_ / "other";
    std::ofstream(file) << "#!/bin/sh\n" << text << "\n";
    fs::permissions(file, fs::perms::owner_all);
    return file;
  }
  static void expect_both(const std::vector<cl::Program>& programs) {
    ASSERT_EQ(programs.size(), 2u);
    EXPECT_NO_THROW(cl::Kernel(programs[0], "accumulate"));
    EXPECT_NO_THROW(cl::Kernel(programs[1], "secondary_rays"));
    EXPECT_THROW(cl::Kernel(programs[0], "secondary_rays"), cl::Error);
    errno = 0;
    EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "a child is left";
    EXPECT_EQ(errno, ECHILD);
  }

  DeviceInfo device_ = device_choose("");
  Context context_{device_};
  std::string options_ = "-DTEST=" + std::to_string(std::random_device{}());
  fs::path folder_ = fs::temp_directory_path() / ("brume-parts-" + std::to_string(::getpid()));
  int asked_ = 0;
};

TEST_F(ProgramParts, TheSecondIsBuiltByTheOther) {
  const std::vector<cl::Program> programs = build(brume_kernels());
  expect_both(programs);
  EXPECT_EQ(asked_, 1);
  EXPECT_TRUE(fs::exists(kept(0)));
  EXPECT_TRUE(fs::exists(kept(1)));  // built here, it would be kept only when it has been used
}

TEST_F(ProgramParts, AreFoundAgain) {
  EXPECT_FALSE(parts_at_hand(context_, source(), options_));
  build(brume_kernels());
  EXPECT_TRUE(parts_at_hand(context_, source(), options_));
  expect_both(build(""));  // in the context
  const Context next(device_);
  EXPECT_TRUE(parts_at_hand(next, source(), options_));
  expect_both(parts_build(next, source(), options_, [] { return ADD_FAILURE(), fs::path(); }));
  EXPECT_EQ(asked_, 1);
}

// Nothing is lost but time.
TEST_F(ProgramParts, WhatTheOtherDoesNotBuildIsBuiltHere) {
  for (const char* text : {"kill -9 $$", "head -c 100 >/dev/null", "sleep 0.2; printf x >&0"}) {
    const std::vector<cl::Program> programs = build(script("sleep 0.1; " + std::string(text)));
    expect_both(programs);
    EXPECT_TRUE(fs::exists(kept(0))) << text;
    EXPECT_FALSE(fs::exists(kept(1))) << text;
    program_used(context_, programs[1]);
    EXPECT_TRUE(fs::exists(kept(1))) << text;
    forget();
  }
}

TEST_F(ProgramParts, WhereTheOtherCannotBeAskedItIsOneProgram) {
  EXPECT_EQ(build("/no/such/program").size(), 1u);
  forget();
  const std::vector<cl::Program> programs = build(script("exit 1"));  // before it is asked, or after
  EXPECT_NO_THROW(cl::Kernel(programs.front(), "accumulate"));
  EXPECT_NO_THROW(cl::Kernel(programs.back(), "secondary_rays"));
}

TEST_F(ProgramParts, WithoutAnotherItIsOneProgram) {
  EXPECT_EQ(build("").size(), 1u);
  EXPECT_EQ(asked_, 1);
  EXPECT_EQ(build(brume_kernels()).size(), 1u) << "the whole has been built already";
  EXPECT_EQ(asked_, 1);
}

TEST_F(ProgramParts, OneCoreBuildsAWhole) {
  device_.compute_units = 1;
  const Context alone(device_);
  EXPECT_EQ(parts_build(alone, source(), options_, [] { return ADD_FAILURE(), fs::path(); }).size(), 1u);
}

TEST_F(ProgramParts, OtherDriversBuildAWhole) {
  device_.platform = "another";  // whose programs are not kept
  const Context other(device_);
  EXPECT_EQ(parts_build(other, source(), options_, [] { return ADD_FAILURE(), fs::path(); }).size(), 1u);
}

TEST_F(ProgramParts, ARequestThatDoesNotFitIsRefused) {
  for (const std::size_t bytes : {0, 17, 40}) {
    HelperProgram program(brume_kernels());
    const std::string zeros(bytes, '\0');
    EXPECT_TRUE(program.send(zeros.data(), zeros.size()));
    if (bytes == 40) {
      char answer;
      EXPECT_FALSE(program.receive(&answer, 1));
    }
    EXPECT_EQ(program.end(), "exit code 1") << bytes;
  }
}

}  // namespace
}  // namespace brume
