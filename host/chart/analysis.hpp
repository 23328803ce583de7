// What the points of a chart say together: which are best, and how errors fall as knobs are turned.
#pragma once
#include <optional>

#include "chart/point.hpp"
#include "image/image.hpp"

namespace brume {

// Marks the points that no other is both quicker and closer than. Errors below `floor`, that of the exact picture
// itself, cannot be told from it: of those the quickest counts.
// How well the plane `error` of a picture tells where it is off from the exact one; nothing where it tells nothing.
std::optional<double> error_rank(const std::vector<float>& expected, const Image& picture, const Image& exact);

void pareto_mark(std::vector<ChartPoint>& points, double floor);

// log(error) falls along log(knob) by this much.
struct OrderExpected {
  const char* knob;  // "step" or "spp"
  double order;
};
// What theory says of a method where light and density are smooth along a step; nothing for methods without a knob.
std::optional<OrderExpected> order_expected(int method);

// Least squares through the points of each method that differ in that knob alone: light traced, rule "segment", f32.
// Left out: errors near `floor`, which is not the method's. Of steps the finest ORDER_STEPS count: coarser ones are not
// near the limit yet. Fewer than three points have no order.
inline constexpr double ORDER_ABOVE_FLOOR = 3;
inline constexpr std::size_t ORDER_STEPS = 3;
std::vector<ChartOrder> orders_fit(const std::vector<ChartPoint>& points, double floor);

}  // namespace brume
