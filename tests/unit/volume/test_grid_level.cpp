// Levels of detail: means of the samples of a finer grid.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "volume/grid_level.hpp"

namespace brume {
namespace {

constexpr Border BORDERS[] = {Border::CLAMP, Border::ZERO};

template <class Visit>
void visit_samples(ivec3 size, Visit visit) {
  for (int z = 0; z < size.z; ++z)
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) visit(ivec3(x, y, z));
}

Grid random_grid(ivec3 size, Border border) {
  Grid grid(size);
  grid.border = border;
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(0, 1);
  visit_samples(size, [&](ivec3 i) { grid.set(i, uniform(random)); });
  return grid;
}

// The integral over the lattice of the full grid.
double integral(const Grid& grid) {
  double sum = 0;
  visit_samples(grid.size(), [&](ivec3 i) { sum += double(grid.at(i)); });
  return sum * grid.spacing.x * grid.spacing.y * grid.spacing.z;
}

TEST(GridLevel, KeepsTheIntegralOfAnySize) {
  for (const Border border : BORDERS)
    for (const ivec3 size : {ivec3(1, 1, 1), ivec3(2, 3, 4), ivec3(17, 16, 9), ivec3(1, 31, 2), ivec3(33, 20, 47)}) {
      const Grid fine = random_grid(size, border), half = grid_halved(fine), quarter = grid_halved(half);
      EXPECT_EQ(half.size(), (size + 1) / 2);
      EXPECT_EQ(half.full_size, size);
      EXPECT_EQ(quarter.full_size, size);
      EXPECT_NEAR(integral(half), integral(fine), 1e-6 * integral(fine)) << size.x << "x" << size.y << "x" << size.z;
      EXPECT_NEAR(integral(quarter), integral(fine), 1e-6 * integral(fine));
      for (int axis = 0; border == Border::CLAMP && axis < 3; ++axis) {
        EXPECT_DOUBLE_EQ(half.size()[axis] * half.spacing[axis], size[axis]);
        EXPECT_DOUBLE_EQ(quarter.size()[axis] * quarter.spacing[axis], size[axis]);
      }
    }
}

TEST(GridLevel, TakesTheMeanOfEight) {
  for (const Border border : BORDERS) {
    const Grid fine = random_grid({18, 10, 34}, border), half = grid_halved(fine);
    visit_samples(half.size(), [&](ivec3 i) {
      double sum = 0;
      visit_samples(ivec3(2), [&](ivec3 d) { sum += double(fine.at(2 * i + d)) / 8; });
      EXPECT_NEAR(half.at(i), sum, 1e-6);
    });
  }
}

// Three samples become two: of the middle one each takes a half.
TEST(GridLevel, SharesWhatLiesBetween) {
  Grid fine({3, 2, 2});
  visit_samples(fine.size(), [&](ivec3 i) { fine.set(i, i.x == 0 ? 3 : i.x == 1 ? 6 : 12); });
  EXPECT_NEAR(grid_halved(fine).at({0, 0, 0}), (3 + 3) / 1.5, 1e-6);
  EXPECT_NEAR(grid_halved(fine).at({1, 0, 0}), (3 + 12) / 1.5, 1e-6);
  fine.border = Border::ZERO;
  EXPECT_NEAR(grid_halved(fine).at({0, 0, 0}), 4.5, 1e-6);
  EXPECT_NEAR(grid_halved(fine).at({1, 0, 0}), 6, 1e-6);  // and nothing behind it
}

TEST(GridLevel, OneValueStaysOneValueAndCostsAsLittle) {
  Grid fine({1000, 1000, 1000});
  fine.fill({0, 0, 0}, {999, 999, 999}, 0.3f);
  Grid level = grid_halved(fine);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(level.at({0, 0, 0}), 0.3f);
    EXPECT_EQ(level.at(level.size() - 1), 0.3f);
    EXPECT_LT(level.stored_bytes(), std::size_t(1) << 21);
    level = grid_halved(level);
  }
}

TEST(GridLevel, TwoVoxelsFarApartCostTwo) {
  Grid fine({5001, 5001, 5001});
  fine.border = Border::ZERO;
  fine.set({0, 0, 0}, 8);
  fine.set({5000, 5000, 5000}, 8);
  const Grid half = grid_halved(fine);
  EXPECT_EQ(half.at({0, 0, 0}), 1);
  EXPECT_EQ(half.at({2500, 2500, 2500}), 1);
  EXPECT_LT(half.stored_bytes(), std::size_t(1) << 21);
}

}  // namespace
}  // namespace brume
