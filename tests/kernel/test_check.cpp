// brume check on PoCL for every lane width: each device function and each picture within its tolerance. PoCL is never skipped.
#include <gtest/gtest.h>

#include <cmath>

#include "check/check.hpp"

namespace brume {
namespace {

class Check : public testing::TestWithParam<int> {};

TEST_P(Check, KernelsAgreeWithTheReference) {
  Context context(device_choose("portable computing language"));
  CheckOptions options;
  options.lanes = {GetParam()};
  options.size = 64;
  const std::vector<CheckRow> rows = check_run(context, options, [](const CheckRow& row) {
    EXPECT_TRUE(row.passed()) << row.name << ": max error " << row.max_error << ", allowed " << row.allowed.limit
                              << ", edges " << row.edges << " of " << row.items;
  });
  EXPECT_GE(rows.size(), 40u);
}

INSTANTIATE_TEST_SUITE_P(Lanes, Check, testing::Values(1, 4, 8, 16), testing::PrintToStringParamName());

TEST(CheckRow, AMissIsSeen) {
  ErrorSum sum("x", 1, "hit");
  sum.add(1.0, 1.0);
  EXPECT_TRUE(sum.row().passed());
  sum.add(1.001, 1.0);
  EXPECT_FALSE(sum.row().passed());
  ErrorSum nan("x", 1, "hit");
  nan.add(NAN, 1.0);
  EXPECT_FALSE(nan.row().passed());
  ErrorSum nothing("x", 1, "hit");
  EXPECT_FALSE(nothing.row().passed());
}

}  // namespace
}  // namespace brume
