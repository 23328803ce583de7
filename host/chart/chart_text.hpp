// A chart as chart.csv and chart.json, and back from the latter.
#pragma once
#include <filesystem>
#include <string>

#include "chart/point.hpp"

namespace brume {

// One line per point, method,step,tolerance,…: a knob that a method does not have is empty.
std::string chart_csv(const Chart& chart);

std::string chart_json(const Chart& chart);
// InputError naming the place in the file where it is no chart.
Chart chart_read(const std::filesystem::path& file);

}  // namespace brume
