// A progress bar on stderr, drawn only on a terminal.
#pragma once
#include "base/stopwatch.hpp"

namespace brume {

class ProgressBar {
 public:
  explicit ProgressBar(bool quiet);
  ~ProgressBar();  // clears the line
  void show(double share);

 private:
  bool visible_;
  bool drawn_ = false;
  Stopwatch since_start_, since_drawn_;
};

}  // namespace brume
