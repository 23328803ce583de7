// See analysis.hpp.
#include "chart/analysis.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/statistics.hpp"

namespace brume {

namespace {

bool turns_spp(const OrderExpected& expected) { return std::string(expected.knob) == "spp"; }

double knob_of(const Knobs& knobs, const OrderExpected& expected) {
  if (turns_spp(expected)) return knobs.spp;
  return std::string(expected.knob) == "step" ? knobs.step : knobs.tolerance;
}

bool in_sweep(const Knobs& knobs, const OrderExpected& expected, int spp) {
  const bool plain =
      knobs.light_grid == 0 && knobs.storage == STORAGE_F32 && knobs.rule == IN_SCATTERING_SEGMENT && knobs.level == 0;
  return plain && (turns_spp(expected) || knobs.spp == spp);
}

struct LogPoint {
  double x, y;
};

double slope_of(const std::vector<LogPoint>& points) {
  double x = 0, y = 0, xx = 0, xy = 0;
  const double n = static_cast<double>(points.size());
  for (const LogPoint& p : points) x += p.x / n, y += p.y / n;
  for (const LogPoint& p : points) xx += (p.x - x) * (p.x - x), xy += (p.x - x) * (p.y - y);
  return xy / xx;
}

// The samples per pixel with which most points of a method turn step or tolerance: those of the scene.
int spp_of_scene(const std::vector<ChartPoint>& points, int method) {
  std::map<int, int> counts;
  for (const ChartPoint& p : points)
    counts[p.knobs.spp] += p.knobs.method == method && (p.knobs.step > 0 || p.knobs.tolerance > 0);
  const auto most =
      std::max_element(counts.begin(), counts.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == counts.end() ? 1 : most->first;
}

}  // namespace

std::optional<double> error_rank(const std::vector<float>& expected, const Image& picture, const Image& exact) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    double off = 0;
    for (std::size_t c = 0; c < 3; ++c) off += picture.values[3 * i + c] - exact.values[3 * i + c];
    errors.push_back(std::abs(off));
  }
  return rank_correlation({expected.begin(), expected.end()}, errors);
}

void pareto_mark(std::vector<ChartPoint>& points, double floor) {
  const auto error = [&](const ChartPoint& p) { return std::max(p.rel_rmse, floor); };
  for (ChartPoint& p : points)
    p.pareto = std::none_of(points.begin(), points.end(), [&](const ChartPoint& other) {
      return other.seconds <= p.seconds && error(other) <= error(p) &&
             (other.seconds < p.seconds || error(other) < error(p));
    });
}

std::optional<OrderExpected> order_expected(int method) {
  const MethodRow row = method_row(method);
  if (row.placement == PLACEMENT_COLLISIONS) return OrderExpected{"spp", -0.5};
  if (row.placement == PLACEMENT_PIECES) return OrderExpected{"tolerance", 1};
  if (row.placement != PLACEMENT_STEPS) return std::nullopt;
  // Places drawn step by step: n independent errors of d² each leave d² √n = d^1.5.
  if (row.draws == DRAWS_PLACES) return OrderExpected{"step", 1.5};
  if (row.rule == RULE_LINEAR) return OrderExpected{"step", 1};  // rays that touch a boundary are a share of all
  return OrderExpected{"step", row.share == 0.5f ? 2.0 : 1.0};
}

std::vector<ChartOrder> orders_fit(const std::vector<ChartPoint>& points, double floor) {
  std::vector<ChartOrder> orders;
  for (int method = 0; method < METHOD_COUNT; ++method) {
    const std::optional<OrderExpected> expected = order_expected(method);
    if (!expected) continue;
    const int spp = spp_of_scene(points, method);
    std::vector<LogPoint> fitted;
    for (const ChartPoint& p : points)
      if (p.knobs.method == method && in_sweep(p.knobs, *expected, spp) && p.rel_rmse > ORDER_ABOVE_FLOOR * floor &&
          p.rel_rmse > 0)
        fitted.push_back({std::log(knob_of(p.knobs, *expected)), std::log(p.rel_rmse)});
    std::sort(fitted.begin(), fitted.end(), [](const LogPoint& a, const LogPoint& b) { return a.x < b.x; });
    if (!turns_spp(*expected) && fitted.size() > ORDER_STEPS) fitted.resize(ORDER_STEPS);
    if (fitted.size() < 3) continue;
    orders.push_back(
        {knobs_method({method}), expected->knob, static_cast<int>(fitted.size()), slope_of(fitted), expected->order});
  }
  return orders;
}

}  // namespace brume
