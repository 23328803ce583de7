// See statistics.hpp.
#include "base/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace brume {

namespace {

// Sum of squares about the mean, and the degrees of freedom that it has.
struct Scatter {
  double squares = 0, freedom = 0;
};

std::vector<double> logs_of(const std::vector<double>& values) {
  std::vector<double> logs;
  logs.reserve(values.size());
  for (const double v : values) logs.push_back(std::log(v));
  return logs;
}

void scatter_add(Scatter& sum, const std::vector<double>& values) {
  double mean = 0;
  for (const double v : values) mean += v / static_cast<double>(values.size());
  for (const double v : values) sum.squares += (v - mean) * (v - mean);
  if (!values.empty()) sum.freedom += static_cast<double>(values.size()) - 1;
}

// Of the median of n values that scatter by 1. Of one or two the median is the mean; of many it scatters √(π/2) times
// as much, of three to five some 1.2.
double median_variance(std::size_t n) {
  return (n <= 2 ? 1.0 : (n <= 5 ? 1.2 * 1.2 : M_PI / 2)) / static_cast<double>(n);
}

// What most pairs scatter by: a median, since the few that were disturbed say nothing of the others.
std::optional<double> variance_common(const std::vector<Scatter>& all) {
  std::vector<double> variances;
  for (const Scatter& s : all)
    if (s.freedom > 0) variances.push_back(s.squares / s.freedom);
  if (variances.empty()) return std::nullopt;
  return quantile(variances, 0.5);
}

// The place of each value among all, from 0; equal ones take the mean of theirs.
std::vector<double> ranks_of(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return values[i] < values[j]; });
  std::vector<double> ranks(values.size());
  for (std::size_t first = 0, last; first < order.size(); first = last) {
    for (last = first; last < order.size() && values[order[last]] == values[order[first]];) ++last;
    for (std::size_t i = first; i < last; ++i) ranks[order[i]] = (static_cast<double>(first + last) - 1) / 2;
  }
  return ranks;
}

}  // namespace

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const double place = share * static_cast<double>(values.size() - 1);
  const std::size_t below = static_cast<std::size_t>(place), above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

Summary summary_of(const std::vector<double>& values) {
  const double tail = values.size() < 5 ? 0 : 0.25;
  return {quantile(values, 0.5), (quantile(values, 1 - tail) - quantile(values, tail)) / 2};
}

std::optional<double> rank_correlation(const std::vector<double>& x, const std::vector<double>& y) {
  const std::vector<double> a = ranks_of(x), b = ranks_of(y);
  const double mean = (static_cast<double>(x.size()) - 1) / 2;
  double ab = 0, aa = 0, bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - mean) * (b[i] - mean);
    aa += (a[i] - mean) * (a[i] - mean);
    bb += (b[i] - mean) * (b[i] - mean);
  }
  if (!(aa > 0 && bb > 0)) return std::nullopt;
  return ab / std::sqrt(aa * bb);
}

std::optional<double> power_fitted(const std::vector<double>& x, const std::vector<double>& y) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double a = std::log(x[i]), b = std::log(y[i]);
    n += 1, sx += a, sy += b, sxx += a * a, sxy += a * b;
  }
  const double width = n * sxx - sx * sx;
  if (!(width > 1e-12)) return std::nullopt;
  return (n * sxy - sx * sy) / width;
}

bool Change::exceeds() const { return noise && std::abs(std::log(ratio)) > *noise; }

std::vector<Change> changes_of(const std::vector<TimesPair>& pairs) {
  std::vector<Scatter> scatter;
  for (const TimesPair& pair : pairs) {
    scatter.push_back({});
    scatter_add(scatter.back(), logs_of(pair.before));
    scatter_add(scatter.back(), logs_of(pair.after));
  }
  const std::optional<double> common = variance_common(scatter);
  std::vector<Change> changes;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto& [before, after] = pairs[i];
    changes.push_back({quantile(after, 0.5) / quantile(before, 0.5), std::nullopt});
    if (!common) continue;
    const double variance = (PRIOR_RUNS * *common + scatter[i].squares) / (PRIOR_RUNS + scatter[i].freedom);
    changes.back().noise =
        CHANGE_SIGMAS * std::sqrt(variance * (median_variance(before.size()) + median_variance(after.size())));
  }
  return changes;
}

}  // namespace brume
