// See progress.hpp.
#include "cli/progress.hpp"

#include <unistd.h>

#include <cstdio>
#include <string>

namespace brume {

ProgressBar::ProgressBar(bool quiet) : visible_(!quiet && isatty(STDERR_FILENO)) {}

ProgressBar::~ProgressBar() {
  if (drawn_) std::fprintf(stderr, "\r\033[K");
}

void ProgressBar::show(double share) {
  if (!visible_ || (drawn_ && since_drawn_.seconds() < 0.1)) return;
  constexpr int width = 40;
  const int filled = static_cast<int>(share * width);
  const double elapsed = since_start_.seconds();
  const double left = share > 0.02 ? elapsed * (1 - share) / share : 0;
  const std::string bar = std::string(filled, '#') + std::string(width - filled, '.');
  std::fprintf(stderr, "\r[%s] %3.0f %%  %.0f s%s\033[K", bar.c_str(), 100 * share, elapsed,
               left > 0 ? (", " + std::to_string(static_cast<int>(left + 1)) + " s left").c_str() : "");
  drawn_ = true;
  since_drawn_.lap();
}

}  // namespace brume
