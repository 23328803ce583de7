// A chart as one page that needs nothing else, and drawn by gnuplot.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "chart/chart_folder.hpp"

namespace brume {

// The bytes as text that a data: URI holds.
std::string base64_text(std::string_view bytes);

// chart/page.html with the chart, the exact picture and the pictures of all points in it.
std::string chart_page(const Chart& chart, const ChartFolder& folder);

// What makes the two files, whose names gnuplot_draw adds: chart/plot.gnuplot after the data.
std::string plot_script(const Chart& chart);

// Makes chart.svg and chart.png. False where there is no gnuplot; RuntimeError where it fails.
bool chart_plot(const Chart& chart, const ChartFolder& folder);

}  // namespace brume
