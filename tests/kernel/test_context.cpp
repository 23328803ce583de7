// What a context counts as allocated follows the lives of its buffers.
#include <gtest/gtest.h>

#include <memory>

#include "base/error.hpp"
#include "check/check_images.hpp"
#include "check/check_parts.hpp"

namespace brume {
namespace {

TEST(Context, CountsTheBuffersThatLive) {
  Context context(device_choose("portable computing language"));
  EXPECT_EQ(context.allocated_bytes(), 0u);
  const cl::Buffer kept = context.buffer("kept", std::vector<float>(250));
  EXPECT_EQ(context.allocated_bytes(), 1000u);
  {
    const cl::Buffer one = context.buffer("one", 4096);
    const cl::Buffer same = one;  // the same memory, counted once
    EXPECT_EQ(context.allocated_bytes(), 5096u);
  }
  EXPECT_EQ(context.allocated_bytes(), 1000u);
}

TEST(Context, CountsNothingForWhatItRefuses) {
  Context context(device_choose("portable computing language"));
  EXPECT_THROW(context.buffer("huge", ~std::size_t{0} / 2), RuntimeError);
  EXPECT_EQ(context.allocated_bytes(), 0u);
}

// Pictures one after the other: a scene's memory is there for the next.
TEST(Context, APictureGivesBackWhatItTook) {
  Context context(device_choose("portable computing language"));
  for (int i = 0; i < 2; ++i) {
    render_film(context, check_scene("surfaces", 8, 8), 8);
    context.queue().finish();
    EXPECT_EQ(context.allocated_bytes(), 0u);
  }
}

TEST(Context, ABufferMayOutliveIt) {
  auto context = std::make_unique<Context>(device_choose("portable computing language"));
  cl::Buffer buffer = context->buffer("buffer", 64);
  context.reset();
  buffer = cl::Buffer();
}

}  // namespace
}  // namespace brume
