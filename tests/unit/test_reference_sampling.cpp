// Random numbers, strata, camera rays and quadrature of the reference.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "flat_scene_builder.hpp"
#include "reference/quadrature.hpp"
#include "reference/sampling.hpp"

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

TEST(ReferencePixel, OneSampleIsTheCentre) { EXPECT_EQ(pixel_position(0, 1, 0.9, 0.1), dvec2(0.5)); }

TEST(ReferencePixel, HandDerivedStrataOfSeven) {
  // 7 samples in 2 columns: first = 0, 4, 7, so 4 in the left column of width 4/7 and 3 in the right one
  const dvec2 left = pixel_position(3, 7, 0.5, 0.25), right = pixel_position(4, 7, 0.5, 0.25);
  EXPECT_NEAR(left.x, 2.0 / 7, 1e-15);
  EXPECT_NEAR(left.y, 3.25 / 4, 1e-15);
  EXPECT_NEAR(right.x, 5.5 / 7, 1e-15);
  EXPECT_NEAR(right.y, 0.25 / 3, 1e-15);
}

TEST(ReferencePixel, CellsAreEqualInAreaAndTileThePixel) {
  for (const int spp : {2, 3, 4, 5, 7, 12, 16, 31, 64}) {
    double area = 0;
    dvec2 mean(0);
    for (int s = 0; s < spp; ++s) {
      const dvec2 lo = pixel_position(s, spp, 0, 0), hi = pixel_position(s, spp, 1, 1);
      EXPECT_NEAR((hi.x - lo.x) * (hi.y - lo.y), 1.0 / spp, 1e-14);
      EXPECT_GE(lo.x, 0);
      EXPECT_LE(hi.y, 1 + 1e-14);
      area += (hi.x - lo.x) * (hi.y - lo.y);
      mean += 0.5 * (lo + hi) / static_cast<double>(spp);
      for (int other = 0; other < s; ++other) {  // no middle lies in another's cell
        const dvec2 middle = pixel_position(other, spp, 0.5, 0.5);
        EXPECT_FALSE(middle.x > lo.x && middle.x < hi.x && middle.y > lo.y && middle.y < hi.y) << spp << ": " << s;
      }
    }
    EXPECT_NEAR(area, 1, 1e-13);
    EXPECT_NEAR(mean.x, 0.5, 1e-13);
    EXPECT_NEAR(mean.y, 0.5, 1e-13);
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
