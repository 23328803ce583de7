// Second moments of a pixel, and pixels put together.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>

#include "film/film.hpp"

using namespace brume;

namespace {

// Reproducible noise in [0,1).
std::vector<float> noise(std::size_t count, unsigned seed) {
  std::vector<float> values;
  for (unsigned x = seed; values.size() < count;)
    values.push_back(float((x = x * 1664525u + 1013904223u) >> 8) / float(1 << 24));
  return values;
}

TEST(FilmPixel, VarianceOfOneSample) {
  Film film({3, 1});
  for (std::size_t i = 0; i < 3; ++i) film.pixels()[i].samples = float(2 * i), film.pixels()[i].squares = {6, 3, 0};
  film.pixels()[2].samples = 1;  // none, two, one sample
  EXPECT_EQ(film.aov(AOV_VARIANCE).values, (std::vector<float>{0, 0, 0, 6, 3, 0, 0, 0, 0}));
  EXPECT_EQ(film.aov(AOV_SAMPLES).values, (std::vector<float>{0, 2, 1}));
}

// A pixel with these samples of radiance (v, v/2, 100 + v), in double.
FilmPixel pixel_of(const std::vector<float>& samples) {
  FilmPixel pixel{};
  pixel.samples = float(samples.size());
  const double n = double(samples.size());
  const auto sum_up = [&](double scale, double offset, float& sum, float& squares) {
    double total = 0, deviations = 0;
    for (const float v : samples) total += scale * double(v) + offset;
    for (const float v : samples) deviations += std::pow(scale * double(v) + offset - total / n, 2);
    sum = float(total);
    squares = float(deviations);
  };
  sum_up(1, 0, pixel.radiance.x, pixel.squares.x);
  sum_up(0.5, 0, pixel.radiance.y, pixel.squares.y);
  sum_up(1, 100, pixel.radiance.z, pixel.squares.z);
  return pixel;
}

TEST(FilmPixel, MergedPixelsHoldTheMomentsOfAllTheirSamples) {
  const std::vector<float> all = noise(64, 7);
  for (const std::ptrdiff_t first : {0, 1, 5, 32, 63, 64}) {
    FilmPixel sum = pixel_of({all.begin(), all.begin() + first});
    film_pixel_merge(sum, pixel_of({all.begin() + first, all.end()}));
    const FilmPixel whole = pixel_of(all);
    EXPECT_EQ(sum.samples, 64);
    EXPECT_NEAR(sum.radiance.x, whole.radiance.x, 1e-5) << first;
    EXPECT_NEAR(sum.squares.x, whole.squares.x, 2e-6 * whole.squares.x) << first;
    EXPECT_NEAR(sum.squares.y, whole.squares.y, 2e-6 * whole.squares.y) << first;
    EXPECT_NEAR(sum.squares.z, whole.squares.z, 2e-5 * whole.squares.z)
        << first;  // the sum's float, 6464, ends earlier
  }
}

// The fields as 23 words, all different: what is a sum adds, the key wraps.
TEST(FilmPixel, MergingAddsEveryField) {
  constexpr std::size_t WORDS = sizeof(FilmPixel) / sizeof(float);
  FilmPixel a{}, b{};
  std::array<float, WORDS> values{};
  for (std::size_t i = 0; i < WORDS; ++i) values[i] = float(i + 1);
  std::memcpy(&a, values.data(), sizeof a);
  for (float& value : values) value *= 16;
  std::memcpy(&b, values.data(), sizeof b);
  a.squares = b.squares = {1, 2, 3};
  a.samples = 2, a.radiance = {2, 4, 6};
  b.samples = 6, b.radiance = {18, 12, 6};  // means 1, 2, 3 and 3, 2, 1; 2 * 6 / 8 = 1.5
  a.key = 0xFFFFFFF0u, b.key = 0x20u;
  FilmPixel sum = a, empty{};
  film_pixel_merge(sum, b);
  EXPECT_EQ(sum.key, 0x10u);
  EXPECT_EQ(sum.samples, 8);
  EXPECT_FLOAT_EQ(sum.squares.x, 2 + 1.5f * 4);
  EXPECT_FLOAT_EQ(sum.squares.y, 4);
  EXPECT_FLOAT_EQ(sum.squares.z, 6 + 1.5f * 4);
  sum.key = a.key = b.key = 0, sum.squares = a.squares = b.squares = {};
  std::array<float, WORDS> first{}, second{}, both{};
  std::memcpy(first.data(), &a, sizeof a);
  std::memcpy(second.data(), &b, sizeof b);
  std::memcpy(both.data(), &sum, sizeof sum);
  for (std::size_t i = 0; i < WORDS; ++i) EXPECT_EQ(both[i], first[i] + second[i]) << "word " << i;
  film_pixel_merge(empty, b);
  EXPECT_EQ(std::memcmp(&empty, &b, sizeof b), 0);
}

}  // namespace
