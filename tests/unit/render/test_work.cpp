// Work lists cut into batches: nothing is left out or done twice, whatever their size.
#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "base/error.hpp"
#include "render/work.hpp"

namespace brume {
namespace {

TEST(Work, AllIsTheCropTimesTheSamples) {
  Frame frame{};
  frame.camera.width = 10, frame.camera.height = 8, frame.camera.spp = 3;
  frame.crop_x0 = 2, frame.crop_x1 = 4, frame.crop_y0 = 5, frame.crop_y1 = 8;
  std::vector<std::uint32_t> pixels;
  for (const PixelWork& work : work_all(frame)) {
    pixels.push_back(work.pixel);
    EXPECT_EQ(work.first_sample, 0u);
    EXPECT_EQ(work.samples, 3u);
  }
  EXPECT_EQ(pixels, (std::vector<std::uint32_t>{52, 53, 62, 63, 72, 73}));
}

TEST(Work, EverySampleIsInOneBatchInTheListsOrder) {
  const WorkList list{{3, 0, 4}, {1, 2, 1}, {2, 0, 0}, {3, 4, 2}, {3, 6, 1}, {0, 5, 40}, {1, 0, 2}};
  std::vector<std::pair<std::uint32_t, std::uint32_t>> expected;
  for (const PixelWork& work : list)
    for (std::uint32_t s = 0; s < work.samples; ++s) expected.emplace_back(work.pixel, work.first_sample + s);
  for (const std::size_t rays : {1, 2, 3, 7, 39, 1000}) {
    WorkQueue queue(list, 4);
    EXPECT_EQ(queue.rays(), expected.size());
    std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
    while (!queue.next(rays).empty()) {
      queue.next(1);  // a smaller one that is not done takes nothing
      const std::vector<Work> batch = queue.next(rays);
      EXPECT_LE(batch_rays(batch), rays);
      std::set<std::uint32_t> pixels;
      std::uint32_t first_ray = 0;
      for (const Work& work : batch) {
        EXPECT_TRUE(pixels.insert(work.pixel).second) << "twice in a batch";
        EXPECT_EQ(work.first_ray, first_ray);
        first_ray += work.samples;
        for (std::uint32_t s = 0; s < work.samples; ++s) found.emplace_back(work.pixel, work.first_sample + s);
      }
      queue.done();
    }
    EXPECT_EQ(found, expected) << rays;
  }
}

TEST(Work, PixelsStayWholeWhereTheyFit) {
  const WorkList list{{0, 0, 4}, {1, 0, 4}, {2, 0, 9}};
  WorkQueue queue(list, 3);
  EXPECT_EQ(queue.next(7).size(), 1u);
  EXPECT_EQ(queue.next(8).size(), 2u);
  queue.done();
  EXPECT_EQ(queue.next(8).front().samples, 8u);
  queue.done();
  EXPECT_EQ(queue.next(8).front().first_sample, 8u);
}

TEST(Work, BeyondTheFilmIsRefused) {
  EXPECT_THROW(WorkQueue({{4, 0, 1}}, 4), RuntimeError);
  EXPECT_THROW(WorkQueue({{0, 0xFFFFFFFFu, 1}}, 4), RuntimeError);
  EXPECT_EQ(WorkQueue({}, 4).next(5).size(), 0u);
}

}  // namespace
}  // namespace brume
