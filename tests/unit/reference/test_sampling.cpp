// Random numbers, positions within a pixel, camera rays and quadrature of the reference.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "reference/quadrature.hpp"
#include "reference/sampling.hpp"
#include "unit/plan/flat_scene_builder.hpp"

namespace brume::reference {
namespace {

// pcg4d once more, step by step with explicit moduli in 64 bits.
double pcg4d_other_way(std::uint64_t x, std::uint64_t y, std::uint64_t z, std::uint64_t w) {
  const std::uint64_t two32 = 1ull << 32;
  const auto seed = [&](std::uint64_t v) { return (v * 1664525ull % two32 + 1013904223ull) % two32; };
  const auto add_product = [&](std::uint64_t a, std::uint64_t b, std::uint64_t c) {
    return (a + b * c % two32) % two32;
  };
  const auto fold = [&](std::uint64_t v) { return v ^ (v / 65536); };
  x = seed(x), y = seed(y), z = seed(z), w = seed(w);
  x = add_product(x, y, w), y = add_product(y, z, x), z = add_product(z, x, y), w = add_product(w, y, z);
  x = fold(x), y = fold(y), z = fold(z), w = fold(w);
  x = add_product(x, y, w);
  return static_cast<double>(x / 256) / 16777216.0;
}

TEST(ReferenceRng, EqualsPcg4dWrittenAnotherWay) {
  for (const uint pixel : {0u, 1u, 77u, 262143u, 0xffffffffu})
    for (const uint sample : {0u, 3u, 0x80000000u})
      for (const uint dimension : {0u, 1u, 9u})
        for (const uint seed : {0u, 12345u})
          EXPECT_EQ(rng_uniform(pixel, sample, dimension, seed), pcg4d_other_way(pixel, sample, dimension, seed));
}

TEST(ReferenceRng, IsUniformInEveryArgument) {
  const int count = 4096, bins = 16;
  for (int argument = 0; argument < 4; ++argument) {
    std::vector<int> histogram(bins);
    double mean = 0;
    for (int i = 0; i < count; ++i) {
      uint a[4] = {5, 6, 7, 8};
      a[argument] = static_cast<uint>(i);
      const double u = rng_uniform(a[0], a[1], a[2], a[3]);
      ASSERT_GE(u, 0);
      ASSERT_LT(u, 1);
      ++histogram[static_cast<std::size_t>(u * bins)];
      mean += u / count;
    }
    EXPECT_NEAR(mean, 0.5, 0.02);                                                               // standard error 0.0045
    for (const int n : histogram) EXPECT_NEAR(n, count / bins, 80) << "argument " << argument;  // 5 standard deviations
  }
}

TEST(ReferenceSobol, FirstPointsByHand) {
  const double expected[2][8] = {{0, 0.5, 0.25, 0.75, 0.125, 0.625, 0.375, 0.875},
                                 {0, 0.5, 0.75, 0.25, 0.625, 0.125, 0.375, 0.875}};
  for (int dimension = 0; dimension < 2; ++dimension)
    for (uint i = 0; i < 8; ++i) EXPECT_EQ(sobol(i, dimension) * 0x1p-32, expected[dimension][i]) << dimension << i;
}

// Points of `position` that share one of the 2^m rectangles of area 2^-m, over every shape of them; 0 for a
// (0,m,2)-net.
template <class Position>
int net_misses(uint first, int m, const Position& position) {
  int misses = 0;
  for (int a = 0; a <= m; ++a) {
    std::vector<bool> taken(std::size_t(1) << m);
    for (uint i = 0; i < 1u << m; ++i) {
      const dvec2 p = position(first + i);
      const auto column = static_cast<std::size_t>(std::ldexp(p.x, a));
      const auto row = static_cast<std::size_t>(std::ldexp(p.y, m - a));
      const std::size_t cell = (row << a) + column;
      misses += taken.at(cell);
      taken[cell] = true;
    }
  }
  return misses;
}

TEST(ReferencePixel, EveryPowerOfTwoOfSamplesIsANet) {
  const auto plain = [](uint i) { return dvec2(sobol(i, 0), sobol(i, 1)) * 0x1p-32; };
  EXPECT_EQ(net_misses(0, 8, plain), 0);
  EXPECT_GT(net_misses(1, 4, plain), 0);  // where no block of 16 begins
  for (const uint pixel : {0u, 1u, 640u, 0xffffffffu})
    for (const uint seed : {0u, 1u, 77u}) {
      const auto of_pixel = [&](uint i) { return pixel_position(pixel, i, 1 << 20, seed); };
      for (int m = 0; m <= 10; ++m) EXPECT_EQ(net_misses(0, m, of_pixel), 0) << pixel << ": " << m;
      for (const uint first : {4u, 16u, 48u, (1u << 20) - 16u})
        EXPECT_EQ(net_misses(first, first == 4 ? 2 : 4, of_pixel), 0) << pixel << ": from " << first;
    }
  EXPECT_EQ(net_misses(0, 16, [](uint i) { return pixel_position(5, i, 1 << 20, 9); }), 0);
}

TEST(ReferencePixel, OneSampleIsTheCentreMoreDoNotDependOnTheirNumber) {
  EXPECT_EQ(pixel_position(7, 0, 1, 3), dvec2(0.5));
  for (uint sample = 0; sample < 4; ++sample)
    EXPECT_EQ(pixel_position(7, sample, 4, 3), pixel_position(7, sample, 1000, 3)) << sample;
}

// The first digits of samples 0 and 1 are opposite, the second ones fall as two coins more: a scrambling with fewer
// random bits than the tree has (a sum with the seed and nothing else) finds four of these eight.
TEST(ReferencePixel, PixelsScrambleApart) {
  const int pixels = 8000;
  for (int axis = 0; axis < 2; ++axis)
    for (const bool by_seed : {false, true}) {
      int counts[8] = {};
      for (uint i = 0; i < uint(pixels); ++i) {
        const auto quarter = [&](uint sample) {
          return static_cast<int>(4 * pixel_position(by_seed ? 3 : i, sample, 16, by_seed ? i : 3)[axis]);
        };
        const int zero = quarter(0), one = quarter(1);
        ASSERT_NE(zero / 2, one / 2);
        ++counts[2 * zero + one % 2];
      }
      for (const int n : counts) EXPECT_NEAR(n, pixels / 8, 150) << "axis " << axis;  // 5 standard deviations
    }
}

TEST(ReferencePixel, EveryBeginningResolvesAnEdgeBetterThanChance) {
  const int pixels = 4000;
  struct Limit {
    uint samples;
    double share;  // of the error of as many independent samples; today's are 0.75, 0.75, 0.59, 0.59, 0.48, 0.41, 0.29
  };
  for (const auto& [samples, share] :
       {Limit{2, 0.8}, {3, 0.8}, {4, 0.65}, {5, 0.7}, {8, 0.55}, {16, 0.47}, {64, 0.35}}) {
    double squares = 0, chance = 0;
    for (uint pixel = 0; pixel < uint(pixels); ++pixel) {
      const double angle = 6.2831853 * rng_uniform(pixel, 1, 5, 1), offset = rng_uniform(pixel, 2, 5, 1) - 0.5;
      const auto inside = [&](const dvec2& p) {
        return (p.x - 0.5) * std::cos(angle) + (p.y - 0.5) * std::sin(angle) > 0.9 * offset;
      };
      double covered = 0, found = 0;
      for (int i = 0; i < 32 * 32; ++i) covered += inside((dvec2(i % 32, i / 32) + 0.5) / 32.0) / 1024.0;
      for (uint s = 0; s < samples; ++s) found += inside(pixel_position(pixel, s, 256, 11)) / double(samples);
      squares += (found - covered) * (found - covered);
      chance += covered * (1 - covered) / samples;
    }
    EXPECT_LT(std::sqrt(squares / chance), share) << samples << " of 256 samples";
  }
}

TEST(ReferenceCamera, OrthographicAndPerspective) {
  Camera camera = test::scene_empty(4).frame.camera;
  const RayD ray = camera_ray(camera, 0, 0, dvec2(0.5));  // top left
  EXPECT_EQ(ray.origin, dvec3(-0.75, 0.75, 8));
  EXPECT_EQ(ray.dir, dvec3(0, 0, -1));
  camera.type = CAMERA_PERSPECTIVE;
  const RayD corner = camera_ray(camera, 3, 3, dvec2(1));  // the lower right corner of the film
  EXPECT_EQ(corner.origin, dvec3(0, 0, 8));
  EXPECT_NEAR(glm::distance(corner.dir, dvec3(1, -1, -1) / std::sqrt(3.0)), 0, 1e-15);
}

TEST(ReferenceQuadrature, IntegratesPolynomialsOfDegree2nMinus1) {
  for (int n = 1; n <= 24; ++n) {
    double weights = 0, top = 0, last = 0;
    for (const QuadratureNode& node : gauss_legendre(n)) {
      EXPECT_GT(node.x, last);
      last = node.x;
      weights += node.weight;
      top += node.weight * std::pow(node.x, 2 * n - 1);
    }
    EXPECT_LT(last, 1);
    EXPECT_NEAR(weights, 1, 1e-13);
    EXPECT_NEAR(top, 1.0 / (2 * n), 1e-13);
  }
}

}  // namespace
}  // namespace brume::reference
