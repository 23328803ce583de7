// chart.svg and chart.png. Without gnuplot there is still the page.
#include <algorithm>
#include <cmath>
#include <map>

#include "base/gnuplot.hpp"
#include "base/number_text.hpp"
#include "chart/page.hpp"
#include "chart_texts.hpp"

namespace brume {

namespace {

// Errors of 0 have no place on a logarithmic axis: they stand in the middle of what cannot be told apart.
std::string place_text(const ChartPoint& p, double floor) {
  const double error = p.rel_rmse > 0 ? p.rel_rmse : std::max(floor / 2, 1e-7);
  return number_text(std::max(p.seconds, 1e-6)) + " " + number_text(error) + "\n";
}

std::string title_of(const Chart& chart) {
  const ChartIdentity& i = chart.identity;
  return i.scene + ", " + std::to_string(i.crop[2] - i.crop[0]) + " x " + std::to_string(i.crop[3] - i.crop[1]) + ", " +
         i.device + ", " + std::to_string(i.lanes) + " lanes";
}

// Of chart/plot.gnuplot, from 1: a method's own, whichever others are there.
int mark_of(int method) { return method == METHOD_NONE ? 1 : method + 1; }

std::string block(const std::string& name, const std::string& lines) { return name + " << EOD\n" + lines + "EOD\n"; }

}  // namespace

std::string plot_script(const Chart& chart) {
  const double floor = chart.exact.rel_rmse;
  struct Series {
    std::string name, points;
  };
  std::map<int, Series> series;  // of each method
  for (const ChartPoint& p : chart.points) {
    Series& its = series[p.knobs.method];
    its.name = knobs_method(p.knobs);
    its.points += place_text(p, floor);
  }
  std::string names, marks, points, front, peers;
  for (const auto& [method, its] : series) {
    names += (names.empty() ? "" : " ") + its.name;
    marks += (marks.empty() ? "" : " ") + std::to_string(mark_of(method));
    points += (points.empty() ? "" : "\n\n") + its.points;  // an index of its own
  }
  std::vector<ChartPoint> best;
  std::copy_if(chart.points.begin(), chart.points.end(), std::back_inserter(best),
               [](const ChartPoint& p) { return p.pareto; });
  std::sort(best.begin(), best.end(), [](const ChartPoint& a, const ChartPoint& b) { return a.seconds < b.seconds; });
  for (const ChartPoint& p : best) front += place_text(p, floor);
  for (const ChartPeer& peer : chart.peers)
    peers += number_text(peer.seconds) + " " + number_text(peer.rel_rmse) + " \"" + peer.name + "\"\n";
  return "chart_title = " + gnuplot_quoted(title_of(chart)) + "\nfloor = " + number_text(floor) +
         "\nmethods = " + gnuplot_quoted(names) + "\nmarks = " + gnuplot_quoted(marks) +
         "\nn_peers = " + std::to_string(chart.peers.size()) + "\n" + block("$points", points) +
         block("$front", front) + block("$peers", peers) + PLOT_GNUPLOT;
}

bool chart_plot(const Chart& chart, const ChartFolder& folder) {
  return gnuplot_draw(folder.file("chart.svg"), folder.file("chart.png"), plot_script(chart));
}

}  // namespace brume
