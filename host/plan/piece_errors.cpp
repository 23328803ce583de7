// See piece_errors.hpp.
#include "plan/piece_errors.hpp"

#include <cmath>
#include <numeric>
#include <set>

namespace brume {

namespace {

constexpr int ROWS = BRICK_SAMPLES * BRICK_SAMPLES, LINES = 3 * ROWS;
constexpr std::size_t ABREAST = 16, ROOM = (LINES + ABREAST - 1) / ABREAST * ABREAST;  // lines that are summed at once
using Weights = std::array<float, BRICK_SAMPLES>;
using Lines = std::array<std::array<float, ROOM>, BRICK_SAMPLES>;  // [place along it][line]; 0 behind the last

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

// All lines along the axes side by side.
void lines_of(const float* samples, Lines& lines) {
  for (int i = 0; i < BRICK_SAMPLES; ++i)
    for (int v = 0; v < BRICK_SAMPLES; ++v)
      for (int u = 0; u < BRICK_SAMPLES; ++u) {
        float* line = &lines[static_cast<std::size_t>(i)][static_cast<std::size_t>(v * BRICK_SAMPLES + u)];
        line[0] = samples[(v * BRICK_SAMPLES + u) * BRICK_SAMPLES + i];
        line[ROWS] = samples[(v * BRICK_SAMPLES + i) * BRICK_SAMPLES + u];
        line[2 * ROWS] = samples[(i * BRICK_SAMPLES + v) * BRICK_SAMPLES + u];
      }
}

// Root of the mean square over all lines: of a cloud that only a corner of the brick sees, a few tell.
float lines_error(const Lines& lines, const Weights& weights) {
  double squares[ABREAST] = {};
  for (std::size_t first = 0; first < ROOM; first += ABREAST) {
    float sums[ABREAST] = {};
    for (std::size_t i = 0; i < BRICK_SAMPLES; ++i)
      for (std::size_t k = 0; k < ABREAST; ++k) sums[k] += weights[i] * lines[i][first + k];
    for (std::size_t k = 0; k < ABREAST; ++k) squares[k] += double(sums[k]) * sums[k];
  }
  return static_cast<float>(std::sqrt(std::accumulate(squares, squares + ABREAST, 0.0) / LINES));
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

GridErrors errors_measure(const FlatScene& flat, const BrickGrid& grid) {
  std::array<Weights, PIECES.size()> pieces;
  std::array<Weights, LIGHT_STEPS.size()> steps;
  for (std::size_t i = 0; i < PIECES.size(); ++i) pieces[i] = error_weights(PIECES[i], 2);
  for (std::size_t i = 0; i < LIGHT_STEPS.size(); ++i) steps[i] = error_weights(LIGHT_STEPS[i], 1);
  GridErrors errors;
  Lines lines{};
  for (const std::int32_t brick : bricks_of(flat, grid)) {
    const float* samples = &flat.voxels[static_cast<std::size_t>(brick) * BRICK_VALUES];
    lines_of(samples, lines);
    BrickErrors its{brick, {}, {}};
    for (std::size_t i = 0; i < PIECES.size(); ++i) its.pieces[i] = lines_error(lines, pieces[i]);
    for (std::size_t i = 0; i < LIGHT_STEPS.size(); ++i) its.steps[i] = lines_error(lines, steps[i]);
    errors.bricks.push_back(its);
    float sum = 0;
    for (int i = 0; i < BRICK_VALUES; ++i) sum += samples[i];
    errors.mean_density += sum / BRICK_VALUES;
  }
  if (!errors.bricks.empty()) errors.mean_density /= static_cast<double>(errors.bricks.size());
  return errors;
}

}  // namespace

const GridErrors& PieceErrors::of(const FlatScene& flat, int grid) {
  const auto found = known_.find(grid);
  if (found != known_.end()) return found->second;
  return known_[grid] = errors_measure(flat, flat.grids[static_cast<std::size_t>(grid)]);
}

}  // namespace brume
