// What a kernel that does not compile says: which device, what its compiler said, and where the source was kept. And
// how texts become one source.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.hpp"
#include "cl/program.hpp"

namespace brume {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

const Context& context() {
  static const Context one(device_choose("portable computing language"));
  return one;
}

std::string failure(const std::string& source, const std::string& options = "") {
  try {
    program_build(context(), source, options);
  } catch (const RuntimeError& error) {
    return error.what();
  }
  return "built";
}

// The last words of the message.
fs::path kept_source(const std::string& message) {
  const std::string start = "source kept in ";
  const std::size_t at = message.find(start);
  return at == std::string::npos ? fs::path() : fs::path(message.substr(at + start.size()));
}

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

TEST(ProgramBuild, AFailureNamesDeviceLogAndKeptSource) {
  const std::string source = kernel_source_text(
      "__kernel void first(__global int* out) { out[0] = 1; }\n"
      "__kernel void second(__global int* out) { out[0] = no_such_name_4711; }\n",
      "tests/broken.cl");
  const std::string message = failure(source, "-DKNOB=17");
  EXPECT_THAT(message, HasSubstr(context().device().name));
  EXPECT_THAT(message, HasSubstr(context().device().driver));
  EXPECT_THAT(message, HasSubstr("CL_BUILD_PROGRAM_FAILURE (-11)"));
  EXPECT_THAT(message, HasSubstr("no_such_name_4711"));  // only the compiler's log can know it
  EXPECT_THAT(message, HasSubstr("-DKNOB=17"));
  const fs::path kept = kept_source(message);
  ASSERT_TRUE(fs::is_regular_file(kept)) << message;
  EXPECT_EQ(text_of(kept), source);
  fs::remove(kept);
}

// Two builds that fail, in one process or in two, keep two sources.
TEST(ProgramBuild, AKeptSourceIsNotOverwritten) {
  const std::string a = "__kernel void a() { missing_a; }\n", b = "__kernel void b() { missing_b; }\n";
  const fs::path kept_a = kept_source(failure(a)), kept_b = kept_source(failure(b));
  EXPECT_NE(kept_a, kept_b);
  EXPECT_EQ(text_of(kept_a), a);
  EXPECT_EQ(text_of(kept_b), b);
  fs::remove(kept_a);
  fs::remove(kept_b);
}

// Where nothing can be written the message must not promise a file, and the failure must still be the compiler's.
TEST(ProgramBuild, AFolderThatCannotBeWrittenDoesNotHideTheCause) {
  const char* old = std::getenv("TMPDIR");
  const std::string before = old ? old : "";
  setenv("TMPDIR", "/no/such/folder", 1);
  const std::string message = failure("__kernel void a() { missing_c; }\n");
  if (old) {
    setenv("TMPDIR", before.c_str(), 1);
  } else {
    unsetenv("TMPDIR");
  }
  EXPECT_THAT(message, HasSubstr("missing_c"));
  EXPECT_THAT(message, Not(HasSubstr("source kept in")));
}

TEST(ProgramBuild, WhatIsRightIsBuilt) {
  cl::Program program =
      program_build(context(), "__kernel void a(__global int* out) { out[0] = KNOB; }\n", "-DKNOB=17");
  EXPECT_NO_THROW(cl::Kernel(program, "a"));
}

TEST(KernelSource, InlinesEachIncludeOnceAndNamesThePlaces) {
  const std::string source =
      kernel_source_text("#include \"shared/bvh.h\"\n#include \"shared/bvh.h\"\nint here;\n", "tests/a.cl");
  const std::string defined = "#define BVH_STACK ";
  const std::size_t at = source.find(defined);
  ASSERT_NE(at, std::string::npos);
  EXPECT_EQ(source.find(defined, at + 1), std::string::npos);
  EXPECT_EQ(source.find("#include \""), std::string::npos);
  EXPECT_EQ(source.rfind("#line 1 \"tests/a.cl\"\n", 0), 0u);
  EXPECT_THAT(source, HasSubstr("#line 1 \"shared/bvh.h\"\n"));
  EXPECT_THAT(source, HasSubstr("#line 2 \"tests/a.cl\"\n"));
  EXPECT_THROW(kernel_source_text("#include \"no/such.cl\"\n", "tests/b.cl"), RuntimeError);
}

// The compiler's messages point to the file and line that a person would open.
TEST(KernelSource, ErrorsPointToTheOriginalLine) {
  const std::string message = failure(kernel_source_text(
      "#include \"shared/bvh.h\"\n\nint fine;\n__kernel void a() { missing_d; }\n", "tests/place.cl"));
  EXPECT_THAT(message, HasSubstr("tests/place.cl:4"));
  fs::remove(kept_source(message));
}

}  // namespace
}  // namespace brume
