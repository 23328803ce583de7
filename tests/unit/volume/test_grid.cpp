// The sparse grid: addressing at every shape, what is stored and what is not, refused sizes, statistics.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "base/error.hpp"
#include "volume/grid.hpp"

using namespace brume;
using testing::AllOf;
using testing::HasSubstr;

namespace {

std::string refusal(ivec3 size) {
  try {
    Grid grid(size);
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

// A value that no other sample of the grid has.
float value_of(ivec3 i, ivec3 size) { return static_cast<float>(1 + i.x + size.x * (i.y + size.y * i.z)); }

TEST(Grid, HoldsEverySampleOfEveryShape) {
  for (int nx : {1, 2, 3, 8, 9, 17})
    for (int ny : {1, 2, 7, 16})
      for (int nz : {1, 3, 8, 10}) {
        const ivec3 size(nx, ny, nz);
        Grid grid(size);
        for (ivec3 i(0); i.z < nz; ++i.z)
          for (i.y = 0; i.y < ny; ++i.y)
            for (i.x = 0; i.x < nx; ++i.x) grid.set(i, value_of(i, size));
        for (ivec3 i(0); i.z < nz; ++i.z)
          for (i.y = 0; i.y < ny; ++i.y)
            for (i.x = 0; i.x < nx; ++i.x) ASSERT_EQ(grid.at(i), value_of(i, size));
      }
}

TEST(Grid, StoresOnlyBlocksThatHoldSomething) {
  Grid grid({64, 64, 64});
  const std::size_t empty = grid.stored_bytes();
  grid.set({5, 5, 5}, 0.0f);
  EXPECT_EQ(grid.stored_bytes(), empty);
  EXPECT_TRUE(grid.block_empty({0, 0, 0}));
  grid.set({8, 16, 63}, 2.0f);
  EXPECT_EQ(grid.stored_bytes(), empty + 512 * sizeof(float) + 512 * sizeof(int));  // and the index of its group
  EXPECT_FALSE(grid.block_empty({1, 2, 7}));
  EXPECT_EQ(grid.at({8, 16, 63}), 2.0f);
  EXPECT_EQ(grid.at({9, 16, 63}), 0.0f);
  grid.set({8, 16, 63}, 0.0f);
  EXPECT_EQ(grid.at({8, 16, 63}), 0.0f);
}

TEST(Grid, BlocksAreTheSamplesInTheirOrder) {
  Grid grid({10, 9, 8});
  for (ivec3 i(0); i.z < 8; ++i.z)
    for (i.y = 0; i.y < 9; ++i.y)
      for (i.x = 0; i.x < 10; ++i.x) grid.set(i, value_of(i, grid.size()));
  ASSERT_EQ(grid.blocks(), ivec3(2, 2, 1));
  const float* block = grid.block({1, 0, 0});
  ASSERT_NE(block, nullptr);
  for (int z = 0; z < 8; ++z)
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x)
        EXPECT_EQ(block[(z * 8 + y) * 8 + x], 8 + x < 10 ? grid.at({8 + x, y, z}) : 0.0f) << x << " " << y << " " << z;
}

TEST(Grid, VisitsEveryStoredSampleOnce) {
  Grid grid({20, 9, 8});
  grid.set({0, 0, 0}, 1.0f);
  grid.set({19, 8, 7}, 2.0f);  // in the block of 4x1x8 samples at the far corner
  std::set<std::array<int, 3>> seen;
  double sum = 0;
  grid_visit_stored(grid, [&](ivec3 i, float v) {
    EXPECT_TRUE(seen.insert({i.x, i.y, i.z}).second);
    EXPECT_EQ(grid.at(i), v);
    sum += v;
  });
  EXPECT_EQ(seen.size(), 512u + 4 * 1 * 8);
  EXPECT_EQ(sum, 3.0);
}

// 2³³ samples: an index in 32 bits would wrap and find the first sample where the last is meant.
TEST(Grid, AddressesBeyond32Bits) {
  const ivec3 last((1 << 20) - 1, (1 << 10) - 1, 7);
  Grid grid(last + 1);
  grid.set(last, 3.0f);
  grid.set({0, 0, 0}, 1.0f);
  EXPECT_EQ(grid.at(last), 3.0f);
  EXPECT_EQ(grid.at({0, 0, 0}), 1.0f);
  const GridStats stats = grid_stats(grid);
  EXPECT_EQ(stats.nonzero, 2u);
  EXPECT_EQ(stats.nonzero_max, last);
  EXPECT_DOUBLE_EQ(stats.mean, 4.0 / double(1ull << 33));
}

// Blocks and groups of one value are held once, also where several calls make them such.
TEST(Grid, HoldsOneValueOnce) {
  Grid grid(ivec3(1000));
  grid.fill(ivec3(0), ivec3(999), 0.5f);
  EXPECT_LT(grid.stored_bytes(), 2u << 20);
  EXPECT_EQ(grid.one_value(ivec3(0), ivec3(999)), 0.5f);
  EXPECT_EQ(grid_stats(grid).nonzero, 1000000000u);
  grid.set({500, 500, 500}, 0.25f);
  EXPECT_EQ(grid.at({500, 500, 500}), 0.25f);
  EXPECT_EQ(grid.at({501, 500, 500}), 0.5f);
  EXPECT_EQ(grid.one_value(ivec3(0), ivec3(999)), std::nullopt);
  EXPECT_EQ(grid.one_value(ivec3(504), ivec3(999)), 0.5f);
  EXPECT_FALSE(grid.block_uniform(ivec3(62)));

  Grid pieces(ivec3(64));
  const std::size_t least = pieces.stored_bytes();
  for (int z = 0; z < 64; z += 5)
    for (int y = 0; y < 64; y += 7) pieces.fill({0, y, z}, glm::min(ivec3(63, y + 6, z + 4), ivec3(63)), 2.0f);
  std::array<float, 512> cube;
  cube.fill(2.0f);
  pieces.set_cube(ivec3(3), cube.data());
  EXPECT_EQ(pieces.one_value(ivec3(0), ivec3(63)), 2.0f);
  EXPECT_EQ(pieces.stored_bytes(), least + 512 * sizeof(float) + 512 * sizeof(int));
  pieces.fill(ivec3(0), ivec3(63), 0.0f);
  EXPECT_EQ(pieces.one_value(ivec3(0), ivec3(63)), 0.0f);
}

// A cube of values anywhere, also beyond the grid's sides: zeros leave alone what is there.
TEST(Grid, SetsCubes) {
  for (const ivec3 lo : {ivec3(0), ivec3(-7, -3, -1), ivec3(5, 8, 11), ivec3(14, 9, 3)}) {
    const ivec3 size(17, 16, 18);
    Grid grid(size), expected(size);
    grid.set({6, 9, 12}, 5.0f);
    expected.set({6, 9, 12}, 5.0f);
    std::array<float, 512> cube{};
    for (int n = 0; n < 512; ++n) {
      const ivec3 i = lo + ivec3(n & 7, (n >> 3) & 7, n >> 6);
      if (n % 3 == 0 || i != glm::clamp(i, ivec3(0), size - 1)) continue;
      cube[static_cast<std::size_t>(n)] = static_cast<float>(n);
      expected.set(i, static_cast<float>(n));
    }
    grid.set_cube(lo, cube.data());
    for (ivec3 i(0); i.z < size.z; ++i.z)
      for (i.y = 0; i.y < size.y; ++i.y)
        for (i.x = 0; i.x < size.x; ++i.x) ASSERT_EQ(grid.at(i), expected.at(i)) << i.x << " " << i.y << " " << i.z;
  }
}

// Stored blocks by z, y, x, across groups.
TEST(Grid, VisitsBlocksInTheirOrder) {
  Grid grid({200, 150, 140});
  std::set<std::array<int, 3>> expected;  // z, y, x
  for (const ivec3 i : {ivec3(199, 149, 139), ivec3(0, 149, 0), ivec3(130, 2, 3), ivec3(3, 2, 3), ivec3(70, 80, 9)}) {
    grid.set(i, 1.0f);
    expected.insert({i.z / 8, i.y / 8, i.x / 8});
  }
  std::vector<std::array<int, 3>> seen;
  grid_visit_blocks(grid, [&](ivec3 b) { seen.push_back({b.z, b.y, b.x}); });
  EXPECT_EQ(seen, std::vector(expected.begin(), expected.end()));
}

TEST(Grid, RefusesSizesThatCannotBe) {
  EXPECT_THAT(refusal({4, 0, 4}), AllOf(HasSubstr("4x0x4"), HasSubstr("at least 1")));
  EXPECT_THAT(refusal({4, 4, -7}), HasSubstr("4x4x-7"));
  EXPECT_THAT(refusal(ivec3(INT32_MAX)),
              AllOf(HasSubstr("2147483647x2147483647x2147483647"), HasSubstr("bytes"), HasSubstr("134217728")));
  EXPECT_THAT(refusal({65536, 65536, 65536}),
              HasSubstr("needs an index of 4294967296 bytes"));  // (2¹⁰)³ groups of 4 bytes
}

TEST(Grid, ExpectFitsCountsTheSamplesToo) {
  EXPECT_NO_THROW(grid_expect_fits("here", {1024, 1024, 1024}, 1024.0 * 1024 * 1024));
  try {
    grid_expect_fits("here", {2048, 2048, 2048}, 2048.0 * 2048 * 2048);
    FAIL() << "accepted 32 GiB";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(),
                AllOf(HasSubstr("here: a grid of 2048x2048x2048"), HasSubstr("34359869440 bytes")));  // 2³⁵ + 2¹⁵·4
  }
  EXPECT_THROW(grid_expect_fits("here", {std::int64_t{1} << 32, 1, 1}, 0), InputError);
}

TEST(GridStats, KnowsTheZerosThatAreNotStored) {
  Grid grid({16, 16, 16});
  grid.set({3, 4, 5}, 2.0f);
  grid.set({12, 4, 6}, 6.0f);
  const GridStats stats = grid_stats(grid);
  EXPECT_EQ(stats.min, 0.0f);
  EXPECT_EQ(stats.max, 6.0f);
  EXPECT_DOUBLE_EQ(stats.mean, 8.0 / 4096);
  EXPECT_EQ(stats.nonzero, 2u);
  EXPECT_EQ(stats.nonzero_min, ivec3(3, 4, 5));
  EXPECT_EQ(stats.nonzero_max, ivec3(12, 4, 6));
  EXPECT_FALSE(stats.constant());
}

TEST(GridStats, ConstantGrids) {
  Grid grid({3, 9, 2});
  GridStats stats = grid_stats(grid);
  EXPECT_TRUE(stats.constant());
  EXPECT_EQ(stats.max, 0.0f);
  EXPECT_GT(stats.nonzero_min.x, stats.nonzero_max.x);  // an empty box
  for (ivec3 i(0); i.z < 2; ++i.z)
    for (i.y = 0; i.y < 9; ++i.y)
      for (i.x = 0; i.x < 3; ++i.x) grid.set(i, 0.25f);
  stats = grid_stats(grid);
  EXPECT_TRUE(stats.constant());
  EXPECT_EQ(stats.min, 0.25f);
  EXPECT_EQ(stats.nonzero, 54u);
}

}  // namespace
