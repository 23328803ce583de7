// A chart: what one scene costs and how far off it is by every method and setting of its knobs.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "chart/knobs.hpp"
#include "witness/witnesses.hpp"

namespace brume {

// One measured setting. Errors are those of image_compare against the exact picture with as many samples.
struct ChartPoint {
  Knobs knobs;
  double seconds = 0;         // of a whole render, median of several
  double seconds_spread = 0;  // half of what lies between the quartiles, of few runs between all
  int runs = 0;
  double build_seconds = 0;  // of its kernels, once
  double lookups = 0;
  double rel_rmse = 0, max_abs = 0, display = 0;  // display: what 99 % of the display values are not further off than
  std::optional<double> error_rank;  // rank correlation of the errors that pixels expect with those that they have
  bool pareto = false;               // nothing is both quicker and closer
};

// The exact picture and what double-precision pixels say of it.
struct ChartExact : WitnessError {
  std::string method;
  int spp = 1;
  double seconds = 0;
};

// log(error) against log(knob), beside what theory says.
struct ChartOrder {
  std::string method, knob;  // "step" or "spp"
  int points = 0;            // that it is fitted through
  double fitted = 0, expected = 0;
};

struct ChartPeer {
  std::string name;
  double seconds = 0, rel_rmse = 0;  // against its own converged picture
};

// What a chart is of: points of charts that agree in all of it can stand in one.
struct ChartIdentity {
  std::string scene, hash;
  std::array<int, 2> size{0, 0};
  std::array<int, 4> crop{0, 0, 0, 0};
  int spp = 1, seed = 0;
  std::string device;
  int lanes = 0;
  bool generic = false;
  std::string version;
};

struct Chart {
  ChartIdentity identity;
  ChartExact exact;
  std::vector<ChartPoint> points;
  std::vector<ChartOrder> orders;
  std::vector<ChartPeer> peers;
  int missing = 0;  // settings that were not measured yet
};

}  // namespace brume
