// See work.hpp.
#include "render/work.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "base/error.hpp"

namespace brume {

// By tiles: rays of pixels that are close to each other are followed together.
WorkList work_all(const Frame& frame) {
  constexpr int TILE = 4;
  WorkList list;
  list.reserve(static_cast<std::size_t>(frame.crop_x1 - frame.crop_x0) *
               static_cast<std::size_t>(frame.crop_y1 - frame.crop_y0));
  for (int top = frame.crop_y0; top < frame.crop_y1; top += TILE)
    for (int left = frame.crop_x0; left < frame.crop_x1; left += TILE)
      for (int y = top; y < std::min(top + TILE, frame.crop_y1); ++y)
        for (int x = left; x < std::min(left + TILE, frame.crop_x1); ++x)
          list.push_back({static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(frame.camera.width) +
                              static_cast<std::uint32_t>(x),
                          0, static_cast<std::uint32_t>(frame.camera.spp)});
  return list;
}

std::uint32_t batch_rays(const std::vector<Work>& batch) {
  return batch.empty() ? 0 : batch.back().first_ray + batch.back().samples;
}

WorkQueue::WorkQueue(const WorkList& list, std::size_t film_pixels) : list_(list) {
  constexpr std::uint32_t SAMPLES_MAX = std::numeric_limits<std::uint32_t>::max();
  std::vector<bool> listed(film_pixels);
  bool repeats = false;
  for (const PixelWork& work : list) {
    if (work.pixel >= film_pixels || work.samples > SAMPLES_MAX - work.first_sample)
      throw RuntimeError("work list: samples " + std::to_string(work.first_sample) + " and " +
                         std::to_string(work.samples) + " from there on of pixel " + std::to_string(work.pixel) +
                         ", but the film has " + std::to_string(film_pixels) + " pixels of fewer than 2^32 samples");
    rays_ += work.samples;
    repeats = repeats || listed[work.pixel];
    listed[work.pixel] = true;
  }
  if (repeats) batch_of_pixel_.resize(film_pixels);
}

bool WorkQueue::taken_before(std::uint32_t pixel) {
  return !batch_of_pixel_.empty() && std::exchange(batch_of_pixel_[pixel], batch_number_) == batch_number_;
}

const std::vector<Work>& WorkQueue::next(std::size_t rays) {
  batch_.clear();
  ++batch_number_;
  std::size_t room = std::min<std::size_t>(rays, std::numeric_limits<std::int32_t>::max());
  std::uint32_t first_ray = 0;
  for (std::size_t i = entry_; i < list_.size() && room > 0; ++i) {
    const std::uint32_t before = i == entry_ ? samples_done_ : 0, left = list_[i].samples - before;
    if (left == 0) continue;
    if ((left > room && !batch_.empty()) || taken_before(list_[i].pixel)) break;
    const auto samples = static_cast<std::uint32_t>(std::min<std::size_t>(left, room));
    batch_.push_back({list_[i].pixel, list_[i].first_sample + before, samples, first_ray});
    first_ray += samples;
    room -= samples;
  }
  return batch_;
}

void WorkQueue::done() {
  std::uint64_t samples = batch_rays(batch_);
  while (entry_ < list_.size() && samples >= list_[entry_].samples - samples_done_) {
    samples -= list_[entry_].samples - samples_done_;
    samples_done_ = 0;
    ++entry_;
  }
  samples_done_ += static_cast<std::uint32_t>(samples);
}

}  // namespace brume
