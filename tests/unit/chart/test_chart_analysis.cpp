// What points say together: the front, the orders, the colours.
#include <gtest/gtest.h>

#include <cmath>

#include "chart/analysis.hpp"
#include "chart/pictures.hpp"
#include "chart_fixture.hpp"

namespace brume {
namespace {

using test::chart_point;

std::vector<bool> front_of(const std::vector<std::array<double, 2>>& places, double floor) {
  std::vector<ChartPoint> points;
  for (const auto& [seconds, error] : places) points.push_back(chart_point({METHOD_DDA_MIDPOINT}, seconds, error));
  pareto_mark(points, floor);
  std::vector<bool> best;
  for (const ChartPoint& p : points) best.push_back(p.pareto);
  return best;
}

TEST(ChartPareto, NothingIsQuickerAndCloser) {
  EXPECT_EQ(front_of({{1, 0.1}, {2, 0.2}, {3, 0.01}, {3, 0.02}, {0.5, 0.5}}, 0),
            (std::vector<bool>{true, false, true, false, true}));
  EXPECT_EQ(front_of({{1, 0.1}, {1, 0.1}}, 0), (std::vector<bool>{true, true}));  // equals
}

TEST(ChartPareto, BelowTheFloorTheQuickestCounts) {
  EXPECT_EQ(front_of({{1, 1e-5}, {2, 0}, {0.5, 1e-2}}, 1e-4), (std::vector<bool>{true, false, true}));
}

std::vector<ChartPoint> falling(int method, double order, double coarse_error) {
  std::vector<ChartPoint> points;
  for (int k = 3; k <= 8; ++k) {
    const double step = std::exp2(-k);
    points.push_back(chart_point({method, step}, 1 / step, k < 6 ? coarse_error : 3 * std::pow(step, order)));
  }
  return points;
}

TEST(ChartOrders, AreThoseOfTheFinestSteps) {
  const std::vector<ChartOrder> orders = orders_fit(falling(METHOD_MARCH_MIDPOINT, 2, 0.1), 1e-9);
  ASSERT_EQ(orders.size(), 1u);
  EXPECT_NEAR(orders[0].fitted, 2, 1e-9);
  EXPECT_EQ(orders[0].expected, 2);
  EXPECT_EQ(orders[0].knob, "step");
  EXPECT_EQ(orders[0].points, 3);
}

TEST(ChartOrders, LeaveOutWhatIsNotTheMethods) {
  std::vector<ChartPoint> points = falling(METHOD_MARCH_REGULAR, 1, 0.1);
  points.push_back(chart_point({METHOD_MARCH_REGULAR, 1.0 / 512}, 1, 1e-3));  // the floor, reached
  points.push_back(chart_point({METHOD_MARCH_REGULAR, 1.0 / 512, 64}, 1, 0.7));
  points.push_back(chart_point({METHOD_MARCH_REGULAR, 1.0 / 512, 0, STORAGE_U8}, 1, 0.7));
  points.push_back(chart_point({METHOD_MARCH_REGULAR, 1.0 / 512, 0, 0, IN_SCATTERING_RECTANGLE}, 1, 0.7));
  const std::vector<ChartOrder> orders = orders_fit(points, 1e-3);
  ASSERT_EQ(orders.size(), 1u);
  EXPECT_NEAR(orders[0].fitted, 1, 1e-9);
  EXPECT_TRUE(orders_fit(points, 1).empty());
}

TEST(ChartOrders, TrackersFallWithSamples) {
  std::vector<ChartPoint> points;
  for (const int spp : {1, 4, 16, 64})
    points.push_back(
        chart_point({METHOD_RATIO_TRACKING, 0, 0, STORAGE_F32, IN_SCATTERING_SEGMENT, spp}, spp, 1 / std::sqrt(spp)));
  const std::vector<ChartOrder> orders = orders_fit(points, 1e-4);
  ASSERT_EQ(orders.size(), 1u);
  EXPECT_NEAR(orders[0].fitted, -0.5, 1e-9);
  EXPECT_EQ(orders[0].expected, -0.5);
  EXPECT_EQ(orders[0].knob, "spp");
}

TEST(ChartOrders, EveryMethodWithStepsOrSamplesHasOne) {
  for (int method = 0; method < METHOD_COUNT; ++method)
    EXPECT_EQ(order_expected(method).has_value(), method_placement(method) != PLACEMENT_CELLS) << method;
  EXPECT_EQ(order_expected(METHOD_MARCH_REGULAR)->order, 1);
  EXPECT_EQ(order_expected(METHOD_MARCH_MIDPOINT)->order, 2);
  EXPECT_EQ(order_expected(METHOD_DELTA_TRACKING)->order, -0.5);
}

TEST(ChartPictures, TheRampIsAsBrightInGrey) {
  double before = -1;
  for (double error = ERROR_LO; error <= ERROR_HI; error *= 1.2) {
    const auto c = error_color(error);
    const double grey = 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
    EXPECT_GT(grey, before) << error;
    before = grey;
  }
  EXPECT_GT(before, 0.9);
  EXPECT_EQ(error_color(0), error_color(ERROR_LO));
  EXPECT_EQ(error_color(50), error_color(ERROR_HI));
}

}  // namespace
}  // namespace brume
