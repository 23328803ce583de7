// The first crossing of the iso-surface of one cell: a million cells and rays against dense sampling in double.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "check/check_parts.hpp"
#include "check/row_scenes.hpp"
#include "plan/planned_scene.hpp"

namespace brume {
namespace {

constexpr int CELLS = 250000;      // of each kind
constexpr int SAMPLES = 1024;      // along each ray
constexpr double THINNEST = 1e-3;  // share of the way through a cell

using Cell = std::array<float, 15>;  // corners, iso, entry, way: as probe_cell takes them

double density(const Cell& cell, double u) {
  double v[8];
  for (int i = 0; i < 8; ++i) v[i] = cell[i];
  for (int axis = 0; axis < 3; ++axis) {
    const double at = cell[9 + axis] + u * cell[12 + axis];
    for (int i = 0; i < 4 >> axis; ++i) v[i] = v[2 * i] * (1 - at) + v[2 * i + 1] * at;
  }
  return v[0] - cell[8];
}

// The density along the ray as the cubic that it is: of a cell it is exact, and quick.
struct Cubic {
  double c0, c1, c2, c3;
  explicit Cubic(const Cell& cell) {
    const double f0 = density(cell, 0), f1 = density(cell, 1.0 / 3), f2 = density(cell, 2.0 / 3), f3 = density(cell, 1);
    c0 = f0;
    c1 = (-11 * f0 + 18 * f1 - 9 * f2 + 2 * f3) / 2;
    c2 = 9 * (2 * f0 - 5 * f1 + 4 * f2 - f3) / 2;
    c3 = 9 * (-f0 + 3 * f1 - 3 * f2 + f3) / 2;
  }
  double at(double u) const { return ((c3 * u + c2) * u + c1) * u + c0; }
  // Where between the ends it turns, nearest to the middle; -1: nowhere.
  double turn() const {
    const double square = c2 * c2 - 3 * c3 * c1, root = std::sqrt(square);
    double best = -1;
    for (const double u : {(-c2 + root) / (3 * c3), (-c2 - root) / (3 * c3)})
      if (u > 0.05 && u < 0.95 && std::abs(u - 0.5) < std::abs(best - 0.5)) best = u;
    return best;
  }
};

// From a point on one face to a point on another.
void ray_make(std::mt19937& random, Cell& cell) {
  std::uniform_real_distribution<float> uniform(0, 1);
  float from[3], to[3];
  for (float* p : {from, to})
    for (int axis = 0; axis < 3; ++axis) p[axis] = uniform(random);
  const int face = static_cast<int>(random() % 6);
  from[face / 2] = static_cast<float>(face % 2);
  const int other = (face + 1 + static_cast<int>(random() % 5)) % 6;
  to[other / 2] = static_cast<float>(other % 2);
  for (int axis = 0; axis < 3; ++axis) {
    cell[9 + axis] = from[axis];
    cell[12 + axis] = to[axis] - from[axis];
  }
}

Cell any_cell(std::mt19937& random) {
  std::uniform_real_distribution<float> uniform(0, 1);
  Cell cell;
  for (int i = 0; i < 8; ++i) cell[i] = uniform(random);
  cell[8] = 0.5f;
  ray_make(random, cell);
  return cell;
}

// Corners below, at and above iso.
Cell cell_of_steps(std::mt19937& random) {
  Cell cell = any_cell(random);
  for (int i = 0; i < 8; ++i) cell[i] = 0.5f * static_cast<float>(random() % 3);
  return cell;
}

// All but one corner a little on one side.
Cell nearly_tangent_cell(std::mt19937& random) {
  Cell cell = any_cell(random);
  for (int i = 0; i < 8; ++i) cell[i] = 0.5f + 1e-3f * (cell[i] - 0.5f);
  cell[random() % 8] += 0.1f;
  return cell;
}

// Iso next to where the density turns, so that it is crossed twice within THINNEST to 16 times that.
Cell twice_crossed_cell(std::mt19937& random) {
  for (;;) {
    Cell cell = any_cell(random);
    const Cubic c(cell);
    const double turn = c.turn(), bend = std::abs(c.c2 + 3 * c.c3 * turn);
    if (turn < 0 || bend < 0.05) continue;
    const double width = THINNEST * std::exp2(4.0 * (random() % 1000) / 1000);
    const double depth = bend * width * width / 4, sign = c.c2 + 3 * c.c3 * turn < 0 ? -1 : 1;
    cell[8] = static_cast<float>(cell[8] + c.at(turn) + sign * depth);
    return cell;
  }
}

// The first sample that is on another side than the first, else 0. What double rounds to one is on none.
int first_change(const Cubic& c) {
  int first = 0;
  for (int i = 0; i <= SAMPLES; ++i) {
    const double f = c.at(double(i) / SAMPLES);
    if (std::abs(f) < 1e-14) continue;
    const int side = f > 0 ? 1 : -1;
    if (first == -side) return i;
    first = side;
  }
  return 0;
}

void expect_none_missed(Cell (*make)(std::mt19937&), const char* kind, double least_crossed) {
  std::mt19937 random(7);
  std::vector<Cell> cells;
  std::vector<float> in;
  for (int i = 0; i < CELLS; ++i) {
    cells.push_back(make(random));
    in.insert(in.end(), cells.back().begin(), cells.back().end());
  }
  Context context(device_choose("portable computing language"));
  const PlannedScene scene = row_scene(shape_desc(SHAPE_ISOSURFACE), "cells", 8, 4);
  const std::vector<float> found = Probe(context, scene, 1).run("probe_cell", in, 15, 1);
  int missed = 0, crossed = 0, late = 0, off = 0;
  for (int i = 0; i < CELLS; ++i) {
    const Cubic c(cells[i]);
    const int change = first_change(c);
    const double u = found[i];
    crossed += change > 0;
    missed += change > 0 && u < 0;
    late += change > 0 && u > (change + 3.0) / SAMPLES;  // where it turns, float knows the place to no more
    // what is found is on the surface, if sampling saw it or not
    off += u >= 0 && std::abs(c.at(u)) > 4e-7 * (1 + std::abs(c.c1) + std::abs(c.c2) + std::abs(c.c3));
  }
  EXPECT_EQ(missed, 0) << kind;
  EXPECT_EQ(late, 0) << kind;
  EXPECT_EQ(off, 0) << kind;
  EXPECT_GT(crossed, least_crossed * CELLS) << kind << ": hardly any is crossed";
}

TEST(CellCrossing, NoneOfAnyCellIsMissed) { expect_none_missed(any_cell, "any", 0.2); }
TEST(CellCrossing, NoneWithCornersOnTheSurfaceIsMissed) { expect_none_missed(cell_of_steps, "steps", 0.2); }
TEST(CellCrossing, NoneAlongTheSurfaceIsMissed) { expect_none_missed(nearly_tangent_cell, "nearly tangent", 0.1); }
TEST(CellCrossing, NoneThatIsCrossedTwiceIsMissed) { expect_none_missed(twice_crossed_cell, "twice", 0.9); }

}  // namespace
}  // namespace brume
