// Before a picture is made: which method, step and light grid reach what is asked for soonest. Candidates render some
// pixels only and are held against the reference there.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/stopwatch.hpp"
#include "chart/chart_scene.hpp"
#include "pilot/goal.hpp"

namespace brume {

struct PilotTrial {
  Knobs knobs;
  WitnessError error;  // on the pilot's pixels
  double seconds = 0;  // that the whole picture is expected to take
};

struct PilotChoice {
  PilotTrial trial;
  bool reached = true;  // as far as the pilot's pixels say
  int trials = 0;       // candidates that were tried
  double seconds = 0;   // that the pilot took, its first look included
};

class Pilot {
 public:
  // `methods`: of which to choose. They should fit the scene; those that draw random numbers are left out: their noise
  // falls with the samples of a pixel, which are not the pilot's to choose. InputError where none is left. Throws
  // Interrupted.
  Pilot(ChartScene& scene, const std::vector<int>& methods);

  // For an error: the quickest candidate that is surely below it, on pixels that had no part in choosing it too; where
  // there is none the closest. For a time: the closest that keeps to it, else the quickest.
  PilotChoice choose(const RenderDesc& goal);

 private:
  struct Panel {  // pixels that are asked
    Witnesses truth;
    WorkList work;
    double mean = 0;
  };
  Panel panel(unsigned seed, double seconds);
  const PilotTrial& trial(const Knobs& knobs);
  WitnessError error_on(const Panel& panel, const Knobs& knobs, double* seconds);
  PilotChoice quickest(const RenderDesc& goal);
  PilotChoice closest(const RenderDesc& goal);

  Stopwatch watch_;  // since it was made
  ChartScene& scene_;
  std::vector<std::vector<Knobs>> families_;  // of one method and light grid, from coarse to fine
  Image preview_;
  double pixels_ = 0;  // of the crop
  Film film_;
  Panel panel_;
  std::map<std::string, PilotTrial> trials_;
};

}  // namespace brume
