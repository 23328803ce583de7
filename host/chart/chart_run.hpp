// Goes through the settings of a chart: exact picture, witnesses, then point after point, of every
// method the cheapest first.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "chart/chart_folder.hpp"
#include "chart/chart_scene.hpp"

namespace brume {

struct ChartRequest {
  std::vector<int> methods;  // that fit; empty for a scene without media
  double budget = 0;         // seconds in all; 0: as long as it takes
  std::function<void(double share)> progress;
  std::function<void(const std::string&)> say;
};

// What an identity says of a scene as it is to be charted.
ChartIdentity identity_of(ChartScene& scene, const std::string& device, const ChartOptions& options,
                          const std::string& version);

// Points in the order of the settings, those of an earlier run among them; each is in chart.json, with its pictures, as
// soon as it is measured. Stops at Ctrl-C and where the budget ends: `missing` says how many are left. InputError where
// the budget ends before there is a point.
Chart chart_run(ChartScene& scene, const ChartFolder& folder, const ChartIdentity& identity,
                const ChartRequest& request);

}  // namespace brume
