// The display curves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "film/film_display.hpp"
#include "image/image.hpp"

using namespace brume;

namespace {

constexpr float INF = std::numeric_limits<float>::infinity();
constexpr float NOT_A_NUMBER = std::numeric_limits<float>::quiet_NaN();

TEST(FilmDisplay, TheCurve) {
  EXPECT_EQ(film_display(0.0f, 0), 0);
  EXPECT_EQ(film_display(-1.0f, 0), 0);
  EXPECT_EQ(film_display(NOT_A_NUMBER, 0), 0);
  EXPECT_EQ(film_display(INF, 0), 1);
  EXPECT_EQ(film_display(1.0f, 0), 1);
  EXPECT_EQ(film_display(2.0f, 0), 1);
  EXPECT_FLOAT_EQ(film_display(0.5f, 0), 0.72974005f);
  EXPECT_FLOAT_EQ(film_display(0.25f, 1), 0.72974005f);
  EXPECT_FLOAT_EQ(film_display(4.0f, -3), 0.72974005f);
}

// From the standard: the two pieces, where they meet, and the inverse that textures are decoded by.
TEST(FilmDisplay, TheCurveOfSrgb) {
  const auto srgb = [](float light, double exposure = 0) { return film_display(light, exposure, TRANSFER_SRGB); };
  EXPECT_EQ(srgb(0), 0);
  EXPECT_EQ(srgb(-1), 0);
  EXPECT_EQ(srgb(NOT_A_NUMBER), 0);
  EXPECT_EQ(srgb(1), 1);
  EXPECT_EQ(srgb(INF), 1);
  EXPECT_FLOAT_EQ(srgb(0.001f), 0.01292f);
  EXPECT_FLOAT_EQ(srgb(0.00025f, 2), 0.01292f);
  EXPECT_NEAR(srgb(0.0031308f), 0.0404499f, 1e-6);
  EXPECT_NEAR(srgb(0.0031309f), 0.0404513f, 1e-6);
  EXPECT_NEAR(srgb(0.18f), 0.4613561f, 1e-6);
  for (int code = 0; code < 256; ++code)
    EXPECT_EQ(std::lround(srgb(static_cast<float>(srgb_decode(code / 255.0))) * 255), code);
}

}  // namespace
