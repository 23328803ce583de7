// See looks.hpp.
#include "pilot/looks.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "film/film_write.hpp"

namespace brume {

namespace {

constexpr double LOOK_PIXELS = 16384;  // at most: fewer miss small parts that are bright
constexpr double SPREAD_SHARE = 0.03, SPREAD_LEAST = 128;

}  // namespace

Look::Look(const Frame& frame)
    : x0_(frame.crop_x0),
      y0_(frame.crop_y0),
      width_(frame.crop_x1 - x0_),
      height_(frame.crop_y1 - y0_),
      side_(static_cast<int>(std::ceil(std::sqrt(double(width_) * height_ / LOOK_PIXELS)))) {}

int Look::middle(int at, int size) const { return std::min(at - at % side_ + side_ / 2, size - 1); }

WorkList Look::work(const WorkList& all, int film_width) const {
  WorkList chosen;
  for (const PixelWork& work : all) {
    const int x = static_cast<int>(work.pixel) % film_width - x0_, y = static_cast<int>(work.pixel) / film_width - y0_;
    if (middle(x, width_) == x && middle(y, height_) == y) chosen.push_back(work);
  }
  return chosen;
}

Image Look::picture(const Film& film) const {
  const auto at = [](int x, int y, int width) { return std::size_t(y) * std::size_t(width) + std::size_t(x); };
  Film shown({width_, height_});
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x)
      shown.pixels()[at(x, y, width_)] =
          film.pixels()[at(x0_ + middle(x, width_), y0_ + middle(y, height_), film.size().x)];
  return film_image(shown);
}

// Every first part of a sequence by the golden ratio is spread over all of it.
WorkList work_spread(const WorkList& all) {
  const auto count = static_cast<std::size_t>(std::max(SPREAD_SHARE * double(all.size()), SPREAD_LEAST));
  std::set<std::size_t> chosen;
  for (std::size_t i = 0; i < count; ++i) {
    const double at = double(i) * 0.6180339887498949;
    chosen.insert(static_cast<std::size_t>((at - std::floor(at)) * double(all.size())));
  }
  WorkList work;
  for (const std::size_t i : chosen) work.push_back(all[i]);
  return work;
}

}  // namespace brume
