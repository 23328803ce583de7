// A chart as a run would leave it, and a folder for it that goes again.
#pragma once
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "chart/point.hpp"

namespace brume::test {

inline ChartPoint chart_point(const Knobs& knobs, double seconds, double rel_rmse) {
  ChartPoint p;
  p.knobs = knobs;
  p.seconds = seconds;
  p.seconds_spread = seconds / 100;
  p.runs = 5;
  p.build_seconds = 1.25;
  p.lookups = 123456789;
  p.rel_rmse = rel_rmse;
  p.max_abs = 2 * rel_rmse;
  p.display = rel_rmse / 2;
  return p;
}

inline Chart chart_example() {
  Chart chart;
  chart.identity = {"fog.json", "0123456789abcdef",   {8, 6}, {0, 0, 8, 6}, 1,
                    0,          "a CPU (a platform)", 8,      false,        "0.1.0"};
  chart.exact = {{48, 3, 1e-4, {0.8e-4, 1.2e-4}, 3e-4, 0}, "dda_gauss2", 1, 0.5};
  chart.points = {
      chart_point({METHOD_DDA_GAUSS2, 0, 0, STORAGE_F32, IN_SCATTERING_SEGMENT, 1}, 0.5, 0),
      chart_point({METHOD_MARCH_MIDPOINT, 0.125, 64, STORAGE_U8, IN_SCATTERING_RECTANGLE, 4}, 0.0123456789, 0.03)};
  chart.orders = {{"march_midpoint", "step", 3, 1.98, 2}};
  chart.peers = {{"vdb_render", 4.5, 0.047}};
  chart.missing = 7;
  return chart;
}

class ChartFolderTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "brume_chart_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_;
};

}  // namespace brume::test
