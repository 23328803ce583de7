// How much work to hand a device at once: little at first, then what takes PACE_S, so that Ctrl-C is answered between
// two pieces.
#pragma once
#include <algorithm>
#include <cstddef>

namespace brume {

class Pace {
 public:
  Pace(std::size_t first, std::size_t most) : most_(std::max<std::size_t>(most, 1)), next_(std::min(first, most_)) {}

  std::size_t next() const { return next_; }
  // Never more than `most` from here on.
  void limit(std::size_t most) {
    most_ = std::max<std::size_t>(most, 1);
    next_ = std::min(next_, most_);
  }
  void took(std::size_t items, double seconds) {
    const double wanted = static_cast<double>(items) * PACE_S / std::max(seconds, 1e-6);
    const double grown = static_cast<double>(next_) * GROWTH;
    next_ = std::clamp<std::size_t>(static_cast<std::size_t>(std::min(wanted, grown)), 1, most_);
  }

 private:
  static constexpr double PACE_S = 0.2, GROWTH = 16;
  std::size_t most_, next_;
};

}  // namespace brume
