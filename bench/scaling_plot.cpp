// scaling.svg and scaling.png, drawn by gnuplot as charts are.
#include <cstdio>

#include "base/atomic_file.hpp"
#include "base/command_line.hpp"
#include "base/error.hpp"
#include "base/number_text.hpp"
#include "base/text_printable.hpp"
#include "peers.hpp"
#include "scaling.hpp"
#include "scaling_texts.hpp"

namespace brume::bench {

namespace {

// Single quotes are doubled in gnuplot's.
std::string plot_quoted(const std::string& text) {
  std::string word = "'";
  for (const char c : text_printable(text)) word += c == '\'' ? "''" : std::string(1, c);
  return word + "'";
}

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
  if (!command_succeeds("command -v gnuplot >/dev/null")) return false;
  AtomicFile svg_file(svg), png_file(png), script(std::filesystem::path(svg).replace_extension(".gnuplot"));
  std::string data;
  int count = 0;
  for (const ScalingAxis& axis : axes) {
    if (axis.points.empty()) continue;
    data += (count++ > 0 ? "\n\n" : "") + axis_lines(axis);
  }
  script.write("plot_title = " + plot_quoted(device) + "\nn_axes = " + std::to_string(count) +
               "\nsvg_file = " + plot_quoted(svg_file.temporary().string()) + "\npng_file = " +
               plot_quoted(png_file.temporary().string()) + "\n$axes << EOD\n" + data + "EOD\n" + SCALING_GNUPLOT);
  if (!command_succeeds("gnuplot " + shell_quoted(script.temporary().string()) + " >/dev/null 2>&1"))
    throw RuntimeError(svg.string() + ": gnuplot could not draw it");
  svg_file.commit();
  png_file.commit();
  return true;
}

}  // namespace brume::bench
