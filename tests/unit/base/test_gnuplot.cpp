// Plots by gnuplot: names and what remains of a plot that fails.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "base/error.hpp"
#include "base/gnuplot.hpp"

namespace brume {
namespace {

TEST(Gnuplot, TextsCannotLeaveTheirQuotes) {
  EXPECT_EQ(gnuplot_quoted("it's\nset output 'x'"), "'it''s?set output ''x'''");
}

class GnuplotFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::system("command -v gnuplot >/dev/null") != 0) GTEST_SKIP() << "no gnuplot";
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_), {}));
  }
  // A folder each: ctest runs both at once.
  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() /
      (std::string("brume it's ") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(GnuplotFolder, BothFilesAreMadeAndTheScriptGoes) {
  EXPECT_TRUE(gnuplot_draw(folder_ / "a.svg", folder_ / "a.png",
                           "set terminal svg\nset output svg_file\nplot x\nset output\n"
                           "set terminal pngcairo\nset output png_file\nplot x\n"));
  EXPECT_GT(std::filesystem::file_size(folder_ / "a.svg"), 1000u);
  EXPECT_GT(std::filesystem::file_size(folder_ / "a.png"), 1000u);
  EXPECT_EQ(files(), 2u);
}

TEST_F(GnuplotFolder, AFailedPlotLeavesNothing) {
  EXPECT_THROW(gnuplot_draw(folder_ / "a.svg", folder_ / "a.png", "plot nothing\n"), RuntimeError);
  EXPECT_EQ(files(), 0u);
}

}  // namespace
}  // namespace brume
