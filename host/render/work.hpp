// What is to be rendered: which pixels and which of their samples, and the batches in which that is done.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "shared/frame.h"
#include "shared/ray.h"

namespace brume {

// Samples [first_sample, first_sample + samples) of a pixel; pixel = y * width + x of the whole film, y = 0 at the top.
struct PixelWork {
  std::uint32_t pixel, first_sample, samples;
};

// In any order; a pixel may stand in it more than once, with other samples.
using WorkList = std::vector<PixelWork>;

// Every sample of every pixel of the crop, row by row.
WorkList work_all(const Frame& frame);

// Cuts a list, which must outlive it, into batches in the list's order.
class WorkQueue {
 public:
  // RuntimeError where a pixel lies beyond `film_pixels` or a sample beyond 32 bits.
  WorkQueue(const WorkList& list, std::size_t film_pixels);

  double rays() const { return rays_; }  // of the whole list
  // What comes next, at most `rays` of them: whole entries, or a part of one that has more. Empty at the end.
  const std::vector<Work>& next(std::size_t rays);
  void done();  // with what next() gave last; without this it gives from the same place again

 private:
  bool taken_before(std::uint32_t pixel);  // by the batch at work, which takes it now

  const WorkList& list_;
  double rays_ = 0;
  std::size_t entry_ = 0;
  std::uint32_t samples_done_ = 0;  // of that entry
  std::vector<Work> batch_;
  std::uint32_t batch_number_ = 0;
  std::vector<std::uint32_t> batch_of_pixel_;  // the last one that it was in; empty where the list has each only once
};

// Rays of a batch as WorkQueue makes it.
std::uint32_t batch_rays(const std::vector<Work>& batch);

}  // namespace brume
