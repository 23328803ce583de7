// Numbers of frames, and names that hold them.
#include "base/frame_pattern.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.hpp"

namespace brume {
namespace {

using testing::ElementsAre;

TEST(FramePattern, NumbersStandInNames) {
  EXPECT_EQ(frame_name("tank_%04d.vdb", 7), "tank_0007.vdb");
  EXPECT_EQ(frame_name("tank_%d.vdb", 7), "tank_7.vdb");
  EXPECT_EQ(frame_name("%02d/%03d", 123), "123/123");
  EXPECT_EQ(frame_name("100%.png", 7), "100%.png");
}

TEST(FramePattern, OtherPercentSignsAreNone) {
  for (const char* text : {"", "%", "a%", "100%.png", "%s", "%4d", "%00d", "%012d", "%0d", "%0", "%04"})
    EXPECT_FALSE(frame_pattern(text)) << text;
  for (const char* text : {"%d", "a%01d", "%%09d", "100%_%04d"}) EXPECT_TRUE(frame_pattern(text)) << text;
}

TEST(FramePattern, ListsAscend) {
  EXPECT_THAT(frames_parse("--frames", "1-4"), ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(frames_parse("--frames", "0-7:3"), ElementsAre(0, 3, 6));
  EXPECT_THAT(frames_parse("--frames", "5"), ElementsAre(5));
  EXPECT_THAT(frames_parse("--frames", "9,1-3,2"), ElementsAre(1, 2, 3, 9));
}

TEST(FramePattern, WhatIsNoListIsRefused) {
  for (const char* text : {"", "x", "4-3", "-1", "1-", "1-4:", "1-4:0", "1--4", "1 - 4", "1-4x", "1,,2", ",1", "1,",
                           "1-4:2:2", "99999999999", "0-999999999"})
    EXPECT_THROW(frames_parse("--frames", text), InputError) << text;
}

TEST(FramePattern, ListsAreToldShort) {
  EXPECT_EQ(frames_name({5}), "frame 5");
  EXPECT_EQ(frames_name({1, 2, 3, 7}), "frames 1-3, 7");
  EXPECT_EQ(frames_name({1, 3, 5, 7, 9, 11, 13, 15, 17, 19}), "frames 1, 3, 5, 7, 9, 11, 13, 15 and 2 more");
}

}  // namespace
}  // namespace brume
