// How finely `adaptive` walks a medium (PICTURE, Pieces): what pieces of each brick would err by, measured along lines
// of its own samples, against what the tolerance allows.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "plan/plan_parts.hpp"

namespace brume {

namespace {

constexpr double SHARE_OF_BRICK = 0.05;  // of the tolerance: what the pieces of one brick may err by
constexpr double LIGHT_COARSER = 16;     // of rays to lights: a pixel is the mean of many, whose errors differ
constexpr std::array<int, 4> PIECES = {1, 2, 4, 8};  // of a brick; more are no cheaper than its cells
constexpr double LINE_CELLS = BRICK_CELLS - 1;       // over which it is
using Weights = std::array<float, BRICK_SAMPLES>;

double largest_sigma_t(const MediumBody& m) {
  return std::max({m.sigma_a.x + m.sigma_s.x, m.sigma_a.y + m.sigma_s.y, m.sigma_a.z + m.sigma_s.z});
}

// Adds to the samples along a line what they bring to length times the density at `at`.
void weights_add(double at, double length, Weights& weights) {
  const double cell = std::floor(at), next = at - cell;
  weights[static_cast<std::size_t>(cell)] += static_cast<float>(length * (1 - next));
  weights[static_cast<std::size_t>(cell) + 1] += static_cast<float>(length * next);
}

// The sum that `points` of each of `pieces` take, less the integral: from the middle of the first cell to that of the
// last, so that pieces and cells do not end together as they hardly ever do.
Weights error_weights(int pieces, int points) {
  constexpr double BEGIN = 0.5;
  Weights weights{};
  for (int cell = 0; cell < BRICK_CELLS; ++cell) {
    const double from = std::max<double>(cell, BEGIN), to = std::min<double>(cell + 1, BEGIN + LINE_CELLS);
    weights_add((from + to) / 2, from - to, weights);  // exact within a cell
  }
  const double length = LINE_CELLS / pieces, apart = points == 2 ? 0.5 / std::sqrt(3.0) : 0;
  for (int piece = 0; piece < pieces; ++piece)
    for (const double side : {-apart, apart}) weights_add(BEGIN + (piece + 0.5 + side) * length, length / 2, weights);
  return weights;
}

double line_sum(const float* first, int stride, const Weights& weights) {
  float sum = 0;
  for (int i = 0; i < BRICK_SAMPLES; ++i) sum += weights[static_cast<std::size_t>(i)] * first[i * stride];
  return sum;
}

// Root of the mean square over all lines along the axes: of a cloud that only a corner of the brick sees, a few tell.
double brick_error(const float* samples, const Weights& weights) {
  constexpr std::array<int, 3> STRIDES = {1, BRICK_SAMPLES, BRICK_SAMPLES * BRICK_SAMPLES};
  double squares = 0;
  int lines = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (int v = 0; v < BRICK_SAMPLES; ++v)
      for (int u = 0; u < BRICK_SAMPLES; ++u, ++lines) {
        const int offset = u * STRIDES[(axis + 1) % 3] + v * STRIDES[(axis + 2) % 3];
        const float* first = samples + offset;
        const double error = line_sum(first, STRIDES[axis], weights);
        squares += error * error;
      }
  return std::sqrt(squares / lines);
}

// The bricks of a grid that are stored, each once.
std::set<std::int32_t> bricks_of(const FlatScene& flat, const BrickGrid& grid) {
  const auto blocks = [](int bricks) {
    const int along = (bricks - 1) / BRICK_BLOCK + 1;
    return static_cast<std::size_t>(along);
  };
  const std::size_t count = blocks(grid.brick_nx) * blocks(grid.brick_ny) * blocks(grid.brick_nz);
  const auto first = flat.bricks.begin() + grid.brick_offset;
  std::set<std::int32_t> numbers;
  for (const std::int32_t block : std::set<std::int32_t>(first, first + static_cast<std::ptrdiff_t>(count)))
    numbers.insert(flat.bricks.begin() + block, flat.bricks.begin() + block + BRICK_BLOCK_ENTRIES);
  numbers.erase(BRICK_EMPTY);
  return numbers;
}

const float* samples_of(const FlatScene& flat, std::int32_t brick) {
  return &flat.voxels[static_cast<std::size_t>(brick) * BRICK_VALUES];
}

double mean_density(const FlatScene& flat, const std::set<std::int32_t>& bricks) {
  double sum = 0;
  for (const std::int32_t brick : bricks) {
    const float* samples = samples_of(flat, brick);
    float its = 0;
    for (int i = 0; i < BRICK_VALUES; ++i) its += samples[i];
    sum += its / BRICK_VALUES;
  }
  return bricks.empty() ? 0 : sum / static_cast<double>(bricks.size());
}

// Flat length of a cell's side, by its volume.
double cell_side(const PlacedGrid& placed) {
  const float* m = placed.world_from_cell.m;
  const glm::dvec3 x(m[0], m[4], m[8]), y(m[1], m[5], m[9]), z(m[2], m[6], m[10]);
  return std::cbrt(std::abs(glm::dot(x, glm::cross(y, z))));
}

// What a medium is walked by, and how much of the tolerance each brick has.
struct Bricks {
  const FlatScene& flat;
  const PlacedGrid& placed;
  std::set<std::int32_t> numbers;
  double side, allowed;  // of a cell; error of a brick, in cells times density

  double error(std::int32_t brick, const Weights& weights) const {
    return brick_error(samples_of(flat, brick), weights);
  }
};

Bricks bricks_judge(double tolerance, const FlatScene& flat, std::size_t medium, const PlacedGrid& placed) {
  Bricks bricks{flat, placed, bricks_of(flat, flat.grids[static_cast<std::size_t>(placed.grid)]), cell_side(placed), 0};
  const double column = mean_density(flat, bricks.numbers) * flat.sizes[medium].longest / 2;
  const double sigma_t = largest_sigma_t(flat.media[medium]);
  bricks.allowed = SHARE_OF_BRICK * tolerance * (sigma_t * column > 1 ? 1 / sigma_t : column) / bricks.side;
  return bricks;
}

// The rows of all bricks; what rays to lights then take on a CPU, in cycles.
double rates_set(const Bricks& bricks, float* rows) {
  constexpr double BRICK_CYCLES = 90, POINT_CYCLES = 8, CELL_BY_CELL = 480;
  std::array<Weights, PIECES.size()> weights;
  for (std::size_t i = 0; i < PIECES.size(); ++i) weights[i] = error_weights(PIECES[i], 2);
  double cycles = 0;
  for (const std::int32_t brick : bricks.numbers) {
    float* row = rows + PIECE_ROW * brick;
    row[PIECE_ROUGH] = 0;  // cells are exact
    for (std::size_t i = PIECES.size(); i-- > 0;) {
      const double error = bricks.error(brick, weights[i]);
      if (error > bricks.allowed * LIGHT_COARSER) break;
      row[PIECE_LIGHT] = float(PIECES[i]) / BRICK_CELLS;
      if (error > bricks.allowed) continue;
      row[0] = row[PIECE_LIGHT];
      row[PIECE_ROUGH] = static_cast<float>(std::pow(error * bricks.side, 2) / LINE_CELLS);
    }
    const double points = 2.0 * BRICK_CELLS * row[PIECE_LIGHT];
    cycles += BRICK_CYCLES + (row[PIECE_LIGHT] < PIECE_RATE_CELLS ? points * POINT_CYCLES : CELL_BY_CELL);
  }
  return cycles;
}

// The longest equal step of rays to lights by which bricks err as little in the mean; 0: it takes longer than pieces.
double light_step(const Bricks& bricks, double cycles) {
  constexpr double STEP_CYCLES = 12, STEPS_COARSER = 6;  // errors of equal steps are more alike from ray to ray
  for (const int steps : {1, 2, 4, 7}) {
    const Weights weights = error_weights(steps, 1);
    double squares = 0;
    for (const std::int32_t brick : bricks.numbers) squares += std::pow(bricks.error(brick, weights), 2);
    const auto count = static_cast<double>(bricks.numbers.size());
    if (squares > count * std::pow(bricks.allowed * STEPS_COARSER, 2)) continue;
    return count * steps * STEP_CYCLES < cycles ? LINE_CELLS / steps * bricks.side : 0;
  }
  return 0;
}

}  // namespace

void adaptive_plan(double tolerance, const FlatScene& flat, std::size_t medium, RenderPlan& plan) {
  MediumWalk& walk = plan.walks[medium];
  walk.tolerance = static_cast<float>(tolerance);
  walk.tau_part = static_cast<float>(std::clamp(std::pow(270 * tolerance, 0.25), 1.0 / 64, 1.0));
  walk.tau_lit = static_cast<float>(std::clamp(std::log(16 / tolerance), 1.0, 24.0));
  const PlacedGrid& placed = flat.placed[static_cast<std::size_t>(medium_placed(flat.media[medium]))];
  if (placed.grid < 0) {
    walk.step = static_cast<float>(flat.sizes[medium].longest * std::min(0.25, std::pow(tolerance, 0.25)));
    return;
  }
  const Bricks bricks = bricks_judge(tolerance, flat, medium, placed);
  walk.piece_rates = static_cast<int>(plan.piece_rates.size());
  plan.piece_rates.resize(plan.piece_rates.size() + PIECE_ROW * flat.voxels.size() / BRICK_VALUES, PIECE_RATE_CELLS);
  const double cycles = rates_set(bricks, &plan.piece_rates[static_cast<std::size_t>(walk.piece_rates)]);
  const double step = light_step(bricks, cycles);
  walk.light_steps = step > 0;
  if (step > 0) walk.step = static_cast<float>(step);
}

}  // namespace brume
