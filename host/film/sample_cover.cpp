// Which samples of which pixels there are.
#include <algorithm>

#include "film/film_partial.hpp"

namespace brume {

std::vector<SampleRange> SampleCover::of(std::size_t pixel) const {
  std::vector<SampleRange> ranges;
  for (const auto& layer : layers_)
    if (layer[pixel].count > 0) ranges.push_back(layer[pixel]);
  return ranges;
}

std::optional<std::uint32_t> SampleCover::held(std::size_t pixel, SampleRange range) const {
  for (const SampleRange& one : of(pixel)) {
    const std::uint32_t first = std::max(one.first, range.first);
    if (first < std::min(one.end(), range.end())) return first;
  }
  return std::nullopt;
}

void SampleCover::add(std::size_t pixel, SampleRange range) {
  if (range.count == 0) return;
  std::vector<SampleRange> ranges = of(pixel), joined;
  ranges.push_back(range);
  std::sort(ranges.begin(), ranges.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const SampleRange& one : ranges)
    if (!joined.empty() && joined.back().end() == one.first)
      joined.back().count += one.count;
    else
      joined.push_back(one);
  while (layers_.size() < joined.size()) layers_.emplace_back(pixels());
  for (std::size_t k = 0; k < layers_.size(); ++k) layers_[k][pixel] = k < joined.size() ? joined[k] : SampleRange{};
}

std::vector<SampleRange> SampleCover::missing(std::size_t pixel, SampleRange wanted) const {
  std::vector<SampleRange> gaps;
  std::uint32_t at = wanted.first;
  const auto gap_until = [&](std::uint32_t end) {
    if (at < end) gaps.push_back({at, end - at});
  };
  for (const SampleRange& one : of(pixel)) {
    gap_until(std::min(one.first, wanted.end()));
    at = std::max(at, one.end());
  }
  gap_until(wanted.end());
  return gaps;
}

ImageWindow SampleCover::window(int width) const {
  ImageWindow window{};
  for (std::size_t i = 0; i < pixels(); ++i) {
    if (has_none(i)) continue;
    const int x = int(i % std::size_t(width)), y = int(i / std::size_t(width));
    if (window.width() == 0) window = {x, y, x + 1, y + 1};
    window = {std::min(window.x0, x), window.y0, std::max(window.x1, x + 1), y + 1};
  }
  return window;
}

}  // namespace brume
