// Numbers that were measured several times, and whether two of them differ by more than their noise.
#pragma once
#include <optional>
#include <vector>

namespace brume {

// Between two of the sorted values where it falls between them. No values: NaN.
double quantile(std::vector<double> values, double share);

struct Summary {
  double median = 0;
  double spread = 0;  // half of what lies between the quartiles, of fewer than five values between the ends
};
Summary summary_of(const std::vector<double>& values);

// Slope of log(y) over log(x), least squares: y grows like x to that power. Nothing for fewer than two x that differ.
std::optional<double> power_fitted(const std::vector<double>& x, const std::vector<double>& y);

// Correlation of the ranks of two lists of the same length [Spearman04]: 1 where one grows with the other, whatever the
// curve; equal values share a rank. Nothing where either is the same throughout.
std::optional<double> rank_correlation(const std::vector<double>& x, const std::vector<double>& y);

// One thing, timed before and after a change.
struct TimesPair {
  std::vector<double> before, after;  // all > 0
};

struct Change {
  double ratio = 1;             // after / before, medians
  std::optional<double> noise;  // of log(ratio): CHANGE_SIGMAS standard errors; nothing where nothing ran twice
  bool exceeds() const;         // it is more than noise
};

// Few runs of one thing hardly tell its noise: a lucky pair lies close together. So what all pairs say of it counts as
// much as PRIOR_RUNS more runs of each, and of what ran once it is all that is known. Logarithms of times scatter alike
// whatever the thing takes, and without a longer tail.
inline constexpr double CHANGE_SIGMAS = 5;  // a hundred things without a change: a false alarm in ten comparisons
inline constexpr double PRIOR_RUNS = 4;
std::vector<Change> changes_of(const std::vector<TimesPair>& pairs);

}  // namespace brume
