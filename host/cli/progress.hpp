// A progress bar on stderr, drawn only on a terminal.
#pragma once
#include <string>

#include "base/stopwatch.hpp"

namespace brume {

class ProgressBar {
 public:
  explicit ProgressBar(bool quiet);
  ~ProgressBar();  // clears the line
  // Share of all there is to do; `what` is being done: "frame 3 of 16".
  void show(double share, const std::string& what = "");
  void clear();  // for another line, until it is shown again

 private:
  bool visible_;
  bool drawn_ = false;
  Stopwatch since_start_, since_drawn_;
};

// "40 s left" after so many seconds and that share of the work; "" where it is too early to say.
std::string time_left(double seconds, double share);

}  // namespace brume
