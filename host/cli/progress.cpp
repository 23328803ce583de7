// See progress.hpp.
#include "cli/progress.hpp"

#include <unistd.h>

#include <cstdio>

namespace brume {

std::string time_left(double seconds, double share) {
  if (!(share > 0.02)) return "";
  const auto left = static_cast<int>(seconds * (1 - share) / share + 1);
  const int minutes = left / 60;
  if (minutes >= 60) return std::to_string(minutes / 60) + " h " + std::to_string(minutes % 60) + " min left";
  return minutes >= 5 ? std::to_string(minutes) + " min left" : std::to_string(left) + " s left";
}

ProgressBar::ProgressBar(bool quiet) : visible_(!quiet && isatty(STDERR_FILENO)) {}

ProgressBar::~ProgressBar() { clear(); }

void ProgressBar::clear() {
  if (drawn_) std::fprintf(stderr, "\r\033[K");
  drawn_ = false;
}

void ProgressBar::show(double share, const std::string& what) {
  if (!visible_ || (drawn_ && since_drawn_.seconds() < 0.1)) return;
  constexpr int width = 40;
  const int filled = static_cast<int>(share * width);
  const double elapsed = since_start_.seconds();
  const std::string bar = std::string(filled, '#') + std::string(width - filled, '.');
  const std::string left = time_left(elapsed, share);
  std::fprintf(stderr, "\r[%s] %3.0f %%  %s%.0f s%s\033[K", bar.c_str(), 100 * share,
               what.empty() ? "" : (what + ", ").c_str(), elapsed, left.empty() ? "" : (", " + left).c_str());
  drawn_ = true;
  since_drawn_.lap();
}

}  // namespace brume
