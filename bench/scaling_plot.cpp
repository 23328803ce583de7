// scaling.svg and scaling.png, drawn by gnuplot as charts are.
#include "base/gnuplot.hpp"
#include "base/number_text.hpp"
#include "scaling.hpp"
#include "scaling_texts.hpp"

namespace brume::bench {

namespace {

std::string axis_lines(const ScalingAxis& axis) {
  const std::optional<double> exponent = axis.exponent();
  std::string lines = "\"" + axis.name + (exponent ? ": " + number_text(*exponent, 2) : "") + "\"\n";
  for (const ScalingPoint& p : axis.points)
    lines += number_text(double(p.value) / axis.points.front().value) + " " +
             number_text(p.seconds / axis.points.front().seconds) + "\n";
  return lines;
}

}  // namespace

bool scaling_plot(const std::string& device, const std::vector<ScalingAxis>& axes, const std::filesystem::path& svg,
                  const std::filesystem::path& png) {
  std::string data;
  int count = 0;
  for (const ScalingAxis& axis : axes) {
    if (axis.points.empty()) continue;
    data += (count++ > 0 ? "\n\n" : "") + axis_lines(axis);
  }
  return gnuplot_draw(svg, png,
                      "plot_title = " + gnuplot_quoted(device) + "\nn_axes = " + std::to_string(count) +
                          "\n$axes << EOD\n" + data + "EOD\n" + SCALING_GNUPLOT);
}

}  // namespace brume::bench
