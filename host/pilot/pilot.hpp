// Before a picture is made: which method, step, rule and light grid reach what is asked for soonest. Candidates render
// some pixels only and are held against the reference there.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/stopwatch.hpp"
#include "pilot/candidates.hpp"
#include "pilot/goal.hpp"

namespace brume {

struct PilotTrial {
  Knobs knobs;
  WitnessError error;  // on the pilot's pixels
  double lookups = 0;  // of the pilot's pixels
  double once = 0;     // s, to fill its light grids
  double seconds = 0;  // that the whole picture is expected to take, with them
  bool timed = false;  // by pixels from all over the picture, not by what the pilot's cost
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
  Panel panel(unsigned seed);
  PilotTrial& trial(const Knobs& knobs);
  WitnessError error_on(const Panel& panel, const Knobs& knobs, PilotTrial* its);
  double seconds_of(const ChartScene::PixelTimes& times, const Panel& panel) const;
  bool good_enough(const PilotTrial& trial, const RenderDesc& goal) const;
  PilotTrial* coarsest(const KnobFamily& family, const RenderDesc& goal);
  double fill_seconds(int grid) const;
  PilotTrial* coarsest_grid(const KnobFamily& family, Knobs knobs, const RenderDesc& goal, double seconds);
  void time(PilotTrial& trial);
  PilotTrial& quickest_of(std::vector<PilotTrial*> good);
  PilotTrial& nearest(int metric);
  PilotChoice quickest(const RenderDesc& goal);
  bool search_goes_on(const RenderDesc& goal) const;
  void finest_within(const KnobFamily& family, int grid, const RenderDesc& goal);
  void try_within(const RenderDesc& goal);
  PilotChoice closest(const RenderDesc& goal);

  Stopwatch watch_;  // since it was made
  ChartScene& scene_;
  std::vector<KnobFamily> families_;
  Image preview_;
  double pixels_ = 0;                   // of the crop
  double least_seconds_ = 0;            // that the whole picture takes by the coarsest candidate
  double effort_seconds_ = 0;           // of one unit of effort
  int too_coarse_ = 0;                  // light grids up to this one were
  bool likely_ = false;                 // none is surely good enough
  std::map<int, double> fill_seconds_;  // of light grids
  Film film_;
  Panel panel_;
  WorkList spread_;  // pixels from all over the crop
  std::map<std::string, PilotTrial> trials_;
};

}  // namespace brume
