// Which pixels are asked how far off a picture is, and what follows from their answers.
#include "witness/witnesses.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace brume {
namespace {

// Of one brightness but for the pixel (3, 1), which is `bright`.
Image picture_of(int width, int height, float value, float bright) {
  Image picture{width,           height, 3, std::vector<float>(3 * std::size_t(width) * std::size_t(height), value),
                {"R", "G", "B"}, false,  0, ""};
  for (std::size_t c = 0; c < 3; ++c) picture.values[3 * (std::size_t(width) + 3) + c] = bright;
  return picture;
}

Frame frame_at(int x, int y) {
  Frame frame{};
  frame.crop_x0 = x;
  frame.crop_y0 = y;
  return frame;
}

TEST(WitnessDraws, AreAllPixelsWhereThereAreNoMore) {
  const WitnessDraws draws = witnesses_draw(picture_of(4, 2, 1, 1), frame_at(10, 20), 8, 1);
  ASSERT_EQ(draws.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(draws[i].x, 10 + int(i % 4));
    EXPECT_EQ(draws[i].y, 20 + int(i / 4));
    EXPECT_EQ(draws[i].weight, 1);
  }
}

TEST(WitnessDraws, AreSpreadOverThePicture) {
  for (const unsigned first : {40u, 200u}) {  // a first part too
    const WitnessDraws draws = witnesses_draw(picture_of(80, 40, 1, 1), frame_at(10, 20), 200, 1);
    std::array<unsigned, 4> quarters{};
    for (std::size_t i = 0; i < first; ++i) {
      ASSERT_TRUE(draws[i].x >= 10 && draws[i].x < 90 && draws[i].y >= 20 && draws[i].y < 60);
      ++quarters[std::size_t((draws[i].x >= 50) + 2 * (draws[i].y >= 40))];
      EXPECT_NEAR(draws[i].weight, 1, 1e-4);
    }
    for (const unsigned count : quarters) EXPECT_NEAR(count, 0.25 * first, 0.1 * first);
  }
}

// A pixel as bright as all others together is half of what is drawn by brightness, and weighs less for it.
TEST(WitnessDraws, AskBrightPixelsMoreOftenAndWeighThemLess) {
  const float bright = 40;  // 40² is what the others have together
  const WitnessDraws draws = witnesses_draw(picture_of(41, 39, 1, bright), frame_at(0, 0), 1000, 1);
  double often = 0, weights = 0;
  for (const WitnessDraw& draw : draws) {
    weights += draw.weight / 1000;
    if (draw.x != 3 || draw.y != 1) continue;
    ++often;
    EXPECT_NEAR(draw.weight * 0.25 * 41 * 39, 1, 0.01);
  }
  EXPECT_NEAR(often, 250, 20);
  EXPECT_NEAR(weights, 1, 0.02);  // they stand for the picture
}

TEST(WitnessError, IsThatOfTheWeighedPixels) {
  Witnesses witnesses;
  Image picture = picture_of(4, 2, 2, 2);
  for (int i = 0; i < 8; ++i) {
    witnesses.draws.push_back({5 + i % 4, 7 + i / 4, 1});
    witnesses.radiance.push_back({2.02, 2.02, 2.02});
  }
  picture.values[3 * 6 + 1] = 2.06f;
  const WitnessError error = witnesses_compare(witnesses, frame_at(5, 7), picture);
  const double expected = std::sqrt((23 * 0.02 * 0.02 + 0.04 * 0.04) / 24) / 2.0025;
  EXPECT_EQ(error.pixels, 8);
  EXPECT_NEAR(error.max_abs, 0.04, 1e-6);
  EXPECT_NEAR(error.rel_rmse, expected, 1e-6);
  EXPECT_LT(error.interval[0], expected);
  EXPECT_GT(error.interval[1], expected);
  EXPECT_GT(error.interval[0], 0.008);
  for (WitnessDraw& draw : witnesses.draws) draw.weight = 4;
  EXPECT_NEAR(witnesses_compare(witnesses, frame_at(5, 7), picture).rel_rmse, 2 * expected, 1e-6);
}

TEST(WitnessError, OfNoPixelsIsNone) {
  EXPECT_EQ(witnesses_compare({}, frame_at(0, 0), picture_of(4, 2, 1, 1)).pixels, 0);
}

// Two samples 1 and 3 in every channel: mean 2, M2 2, standard error of the mean 1.
TEST(FilmNoise, IsTheStandardErrorOverTheMean) {
  Film film({4, 2});
  for (FilmPixel& pixel : film.pixels()) {
    pixel.samples = 2;
    pixel.radiance = {4, 4, 4};
    pixel.squares = {2, 2, 2};
  }
  Frame frame = frame_at(1, 0);
  frame.crop_x1 = 4;
  frame.crop_y1 = 2;
  EXPECT_NEAR(film_noise(film, frame), 0.5, 1e-12);
  for (FilmPixel& pixel : film.pixels()) pixel.samples = 1;
  EXPECT_EQ(film_noise(film, frame), 0);  // nobody knows
}

}  // namespace
}  // namespace brume
