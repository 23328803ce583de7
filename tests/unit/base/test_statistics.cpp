// Medians, spreads, powers, and which changes of times are more than noise.
#include "base/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace brume {
namespace {

constexpr int THINGS = 72;  // as many as brume bench has
constexpr double NOISE = 0.02;

// `runs` times of each thing, from a millisecond to a minute; those of the thing `slower` take `factor` times as long.
std::vector<TimesPair> measured(std::mt19937& random, int runs, int slower = -1, double factor = 1) {
  std::normal_distribution<double> scatter(0, NOISE);
  std::vector<TimesPair> pairs;
  for (int i = 0; i < THINGS; ++i) {
    const double seconds = std::pow(10.0, -3 + 4.7 * i / THINGS);
    TimesPair pair;
    for (int run = 0; run < runs; ++run) {
      pair.before.push_back(seconds * std::exp(scatter(random)));
      pair.after.push_back(seconds * (i == slower ? factor : 1) * std::exp(scatter(random)));
    }
    pairs.push_back(pair);
  }
  return pairs;
}

int alarms(const std::vector<Change>& changes) {
  int sum = 0;
  for (const Change& change : changes) sum += change.exceeds();
  return sum;
}

TEST(Statistics, QuantilesLieBetweenTheValues) {
  EXPECT_DOUBLE_EQ(quantile({3, 1, 2}, 0.5), 2);
  EXPECT_DOUBLE_EQ(quantile({4, 1, 2, 3}, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(quantile({7}, 0.25), 7);
  EXPECT_DOUBLE_EQ(quantile({0, 10}, 1), 10);
  EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
}

TEST(Statistics, SpreadIsBetweenTheEndsOfFewAndTheQuartilesOfMany) {
  EXPECT_DOUBLE_EQ(summary_of({5}).spread, 0);
  EXPECT_DOUBLE_EQ(summary_of({1, 2, 7}).median, 2);
  EXPECT_DOUBLE_EQ(summary_of({1, 2, 7}).spread, 3);
  EXPECT_DOUBLE_EQ(summary_of({1, 2, 3, 4, 100}).spread, 1);  // one that was disturbed does not widen it
}

TEST(Statistics, PowersAreFound) {
  EXPECT_NEAR(*power_fitted({1, 2, 4, 8}, {3, 12, 48, 192}), 2, 1e-12);
  EXPECT_NEAR(*power_fitted({16, 64}, {5, 5}), 0, 1e-12);
  EXPECT_FALSE(power_fitted({4, 4}, {1, 2}));
  EXPECT_FALSE(power_fitted({4}, {1}));
}

// 500 comparisons without a change: the text promises a false alarm in ten of them.
TEST(Statistics, NoiseIsHardlyEverTakenForAChange) {
  for (const int runs : {3, 5, 9}) {
    std::mt19937 random(11);
    int all = 0;
    for (int i = 0; i < 500; ++i) all += alarms(changes_of(measured(random, runs)));
    EXPECT_LE(all, 50) << runs << " runs";
  }
}

TEST(Statistics, AChangeBeyondTheNoiseIsFound) {
  std::mt19937 random(12);
  int found = 0, small = 0;
  for (int i = 0; i < 100; ++i) {
    found += changes_of(measured(random, 5, 30, 1.2))[30].exceeds();
    small += changes_of(measured(random, 5, 30, 1.01))[30].exceeds();
  }
  EXPECT_GE(found, 95);
  EXPECT_LE(small, 5);
  const std::vector<Change> quicker = changes_of(measured(random, 5, 30, 0.5));
  EXPECT_TRUE(quicker[30].exceeds());
  EXPECT_NEAR(quicker[30].ratio, 0.5, 0.05);
}

// A lucky pair of runs that agree does not make its noise 0.
TEST(Statistics, RunsThatAgreeByChanceHaveTheNoiseOfTheOthers) {
  std::mt19937 random(13);
  std::vector<TimesPair> pairs = measured(random, 3);
  pairs[5] = {{1.00, 1.00, 1.00}, {1.01, 1.01, 1.01}};
  EXPECT_FALSE(changes_of(pairs)[5].exceeds());
}

TEST(Statistics, WhatRanOnceIsJudgedByTheOthers) {
  std::mt19937 random(14);
  std::vector<TimesPair> pairs = measured(random, 5);
  pairs[7] = {{10}, {10.3}};
  pairs[8] = {{10}, {16}};
  const std::vector<Change> changes = changes_of(pairs);
  EXPECT_FALSE(changes[7].exceeds());
  EXPECT_TRUE(changes[8].exceeds());
}

TEST(Statistics, WithoutASecondRunNothingIsKnownOfNoise) {
  const std::vector<Change> changes = changes_of({{{1}, {9}}, {{2}, {2}}});
  EXPECT_FALSE(changes[0].noise);
  EXPECT_FALSE(changes[0].exceeds());
}

TEST(Statistics, RankCorrelationSeesOnlyTheOrder) {
  EXPECT_DOUBLE_EQ(*rank_correlation({1, 2, 3, 4}, {0, 1, 100, 1e6}), 1);
  EXPECT_DOUBLE_EQ(*rank_correlation({1, 2, 3, 4}, {5, 4, 3, -7}), -1);
  EXPECT_DOUBLE_EQ(*rank_correlation({1, 2, 3}, {1, 3, 2}), 0.5);
  EXPECT_DOUBLE_EQ(*rank_correlation({1, 1, 2, 2}, {1, 2, 1, 2}), 0);  // equal values share a rank
  EXPECT_FALSE(rank_correlation({1, 2, 3}, {7, 7, 7}));
  EXPECT_FALSE(rank_correlation({}, {}));
}

}  // namespace
}  // namespace brume
